// Defines the rows of the table, and converts values to and from text. See settings_table.h.
#include "render/settings_table.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLES_MAX (GLINT_SAMPLES_PER_AXIS_MAX * GLINT_SAMPLES_PER_AXIS_MAX)

// ---- Values with custom text -------------------------------------------------------------------

static glint_status parse_samples(const glint_option *option, const char *text, void *destination,
                                  glint_error *error)
{
    glint_settings *settings = destination;
    long long samples;
    const bool is_number = glint_parse_int(text, &samples);
    for (int root = 1; is_number && root <= GLINT_SAMPLES_PER_AXIS_MAX; root++) {
        if (samples == root * root) {
            settings->samples_per_axis = root;
            return GLINT_OK;
        }
    }
    return glint_fail(error, GLINT_USAGE,
                      "--%s %s: a square number of samples is expected (1, 4, 9, 16 … %d)",
                      option->name, text, SAMPLES_MAX);
}

static void print_samples(const glint_settings *settings, char text[GLINT_SETTING_TEXT])
{
    const long long root = settings->samples_per_axis;
    snprintf(text, GLINT_SETTING_TEXT, "%lld", root > 0 ? root * root : root);
}

// Prints with the fewest digits that give the same number again.
static void print_real(double number, char text[GLINT_SETTING_TEXT])
{
    int digits = 6;
    do {
        snprintf(text, GLINT_SETTING_TEXT, "%.*g", digits, number);
    } while (digits++ < 17 && strtod(text, NULL) != number);
}

// Parses "0.2,0.2,0.25": radiance R, G, B. Returns false for any other text.
static bool parse_backdrop(const char *text, double backdrop[4])
{
    double color[3];
    if (!glint_parse_reals(text, color, 3) || color[0] < 0 || color[1] < 0 || color[2] < 0) {
        return false;
    }
    memcpy(backdrop, color, sizeof color);
    backdrop[3] = 1;
    return true;
}

// Parses "env", "transparent", a colour, or the file of a plate, whose name contains a point or a
// slash.
static glint_status parse_background(const glint_option *option, const char *text,
                                     void *destination, glint_error *error)
{
    static const char *const words[] = {"env", "transparent", NULL};
    glint_settings *settings = destination;
    const bool is_env = strcmp(text, words[0]) == 0;
    double backdrop[4] = {0};
    const bool is_plate = !is_env && strcmp(text, words[1]) != 0 && !parse_backdrop(text, backdrop);
    if (!is_plate || strpbrk(text, "./") != NULL) {
        settings->transparent = !is_env;
        settings->plate = is_plate ? text : NULL;
        memcpy(settings->backdrop, backdrop, sizeof backdrop);
        return GLINT_OK;
    }
    const char *nearest = glint_nearest_word(text, words);
    return nearest != NULL
               ? glint_fail(error, GLINT_USAGE, "--%s %s: did you mean %s?", option->name, text,
                            nearest)
               : glint_fail(error, GLINT_USAGE,
                            "--%s %s: env or transparent, or an image's file, or a colour "
                            "R,G,B is expected",
                            option->name, text);
}

static void print_background(const glint_settings *settings, char text[GLINT_SETTING_TEXT])
{
    char color[3][GLINT_SETTING_TEXT];
    if (settings->backdrop[3] == 0) {
        snprintf(text, GLINT_SETTING_TEXT, "%s", settings->transparent ? "transparent" : "env");
        return;
    }
    for (int c = 0; c < 3; c++) {
        print_real(settings->backdrop[c], color[c]);
    }
    snprintf(text, GLINT_SETTING_TEXT, "%.30s,%.30s,%.30s", color[0], color[1], color[2]);
}

static glint_status parse_aovs(const glint_option *option, const char *text, void *destination,
                               glint_error *error)
{
    glint_settings *settings = destination;
    return glint_aovs_parse(option->name, text, &settings->aovs, error);
}

static void print_aovs(const glint_settings *settings, char text[GLINT_SETTING_TEXT])
{
    glint_aovs_print(settings->aovs, text, GLINT_SETTING_TEXT);
}

// ---- The table ---------------------------------------------------------------------------------

// Members without a value are 0: auto, float, exact, none.
const glint_settings glint_settings_default = {
    .width = 1280,
    .height = 720,
    .samples_per_axis = 1,
    .min_weight = 1.0 / 1024,
    .anisotropy = 8,
    .facets = 64,
    .wavelengths = 3,
};

static const char *const shadings[] = {[GLINT_SHADING_PIXEL] = "pixel",
                                       [GLINT_SHADING_VERTEX_DIRECTION] = "vertex-direction",
                                       [GLINT_SHADING_VERTEX_COLOR] = "vertex-color",
                                       NULL};

#define OF(member) offsetof(glint_settings, member)
#define TYPE_OF(member)                                                                            \
    _Generic(((const glint_settings *)0)->member, bool                                             \
             : GLINT_SETTING_BOOL, int                                                             \
             : GLINT_SETTING_INT, unsigned                                                         \
             : GLINT_SETTING_UNSIGNED, double                                                      \
             : GLINT_SETTING_REAL, const double *                                                  \
             : GLINT_SETTING_REAL)
#define MEMBER(member)                                                                             \
    .offset = OF(member), .size = sizeof((const glint_settings *)0)->member, .type = TYPE_OF(member)

// Width and height are one value, int[2].
static_assert(OF(height) == OF(width) + sizeof(int), "the height follows the width");

// In the order of reports and help texts. Choices are in the order of their enums.
const glint_setting glint_setting_table[] = {
    {GLINT_SETTINGS_OF_SIZE, .offset = OF(width), .size = 2 * sizeof(int),
     .type = GLINT_SETTING_INT, .fingerprint = 1,
     .option = {GLINT_OPTION_SIZE, .name = "size", .argument = "WxH",
                .help = "Width and height of the frame in pixels.", .minimum = 1,
                .maximum = GLINT_SIDE_MAX}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(samples_per_axis), .fingerprint = 3, .key = "samples",
     .print = print_samples,
     .option = {GLINT_OPTION_CUSTOM, .name = "samples", .argument = "K2",
                .help = "Samples a pixel, a square number: a regular grid.",
                .parse = parse_samples}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(depth), .fingerprint = 4, .key = "depth",
     .roles = GLINT_SETTING_VARIES | GLINT_SETTING_WEIGHS_ERRORS,
     .option = {GLINT_OPTION_INT, .name = "depth", .argument = "N|auto",
                .help = "Number of surfaces that a path meets before it takes the environment "
                        "along its direction. 1 is environment mapping, 2 goes into glass and out. "
                        "auto follows paths until --min-weight ends them, over at most 64 "
                        "surfaces. It stops earlier if glint proves that paths meet nothing more.",
                .minimum = 1, .maximum = 65535, .zero = "auto"}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(min_weight), .fingerprint = 5, .key = "min_weight",
     .roles = GLINT_SETTING_VARIES | GLINT_SETTING_WEIGHS_ERRORS,
     .option = {GLINT_OPTION_REAL, .name = "min-weight", .argument = "W",
                .help = "A branch with a weight below W takes the environment at once. 0 follows "
                        "every branch to --depth.",
                .fallback = "1/1024", .minimum = 0, .maximum = 1}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(transparent), .fingerprint = 6, .key = "background",
     .no_capture = "an environment has no holes", .print = print_background,
     .option = {GLINT_OPTION_CUSTOM, .name = "background", .argument = "KIND|R,G,B|PLATE",
                .help = "The background: env, the environment; transparent, none, with alpha; a "
                        "colour in linear radiance, 0.18,0.18,0.18. render also takes a picture of "
                        "the frame's size, plate.exr, or one for each frame, plate.####.exr.",
                .parse = parse_background}},
    {GLINT_SETTINGS_OF_ENVIRONMENT, MEMBER(env_rotate), .fingerprint = 7,
     .key = "env_rotate_degrees",
     .option = {GLINT_OPTION_REAL, .name = "env-rotate", .argument = "DEG",
                .help = "Turn the environment about +Y by degrees, counter-clockwise seen from "
                        "above.",
                .minimum = -1e6, .maximum = 1e6}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(precision), .fingerprint = 8, .key = "precision",
     .roles = GLINT_SETTING_VARIES | GLINT_SETTING_WEIGHS_ERRORS,
     .option = {GLINT_OPTION_CHOICE, .name = "precision", .argument = "KIND",
                .help = "float or double arithmetic on the device.",
                .choices = GLINT_CHOICES("float", "double")}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(mend), .fingerprint = 18, .key = "mend",
     .metadata = "glint:mend", .roles = GLINT_SETTING_VARIES | GLINT_SETTING_WEIGHS_ERRORS,
     .option = {GLINT_OPTION_REAL, .name = "mend", .argument = "JUMP",
                .help = "With --precision float, render pixels again in double if they differ from "
                        "a neighbour by more than JUMP times the mean of the frame (try 0.3). This "
                        "mends single wrong pixels at edges and folds of glass. 0 mends nothing.",
                .minimum = 0, .maximum = 1e6}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(fresnel), .fingerprint = 9, .key = "fresnel",
     .roles = GLINT_SETTING_WEIGHS_ERRORS,
     .option = {GLINT_OPTION_CHOICE, .name = "fresnel", .argument = "KIND",
                .help = "exact: reflectance depends on the angle. none: metal reflects its base "
                        "colour, glass reflects only totally, paint reflects nothing.",
                .choices = GLINT_CHOICES("exact", "none")}},
    // Not in the settings' part of the fingerprint: the fingerprint holds the plan's choice, see
    // fingerprint.c.
    {GLINT_SETTINGS_OF_FRAME, MEMBER(texels), .key = "texels",
     .roles = GLINT_SETTING_VARIES | GLINT_SETTING_WEIGHS_ERRORS,
     .option = {GLINT_OPTION_CHOICE, .name = "texels", .argument = "KIND",
                .help = "Texels of the environment on the device: half is faster and holds values "
                        "up to 65504. auto takes half if the rounding does no harm, and float with "
                        "--precision double.",
                .choices = GLINT_CHOICES("auto", "half", "float")}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(filter), .fingerprint = 11, .key = "filter",
     .roles = GLINT_SETTING_IS_COMPARED,
     .option = {GLINT_OPTION_CHOICE, .name = "filter", .argument = "KIND",
                .help = "How a look-up reads the environment: bilinear, between the four nearest "
                        "texels; mip, averaged over the footprint of the pixel, so that small "
                        "bright details do not sparkle in curved mirrors and glass.",
                .choices = GLINT_CHOICES("bilinear", "mip")}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(anisotropy), .fingerprint = GLINT_FINGERPRINT_BY_NAME,
     .key = "anisotropy", .roles = GLINT_SETTING_VARIES,
     .option = {GLINT_OPTION_INT, .name = "anisotropy", .argument = "N",
                .help = "Largest number of texture look-ups along the footprint of a pixel. More "
                        "keep floors sharp towards the horizon and take more time. 1 blurs them.",
                .minimum = 1, .maximum = 16}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(irradiance), .fingerprint = 13, .key = "irradiance",
     .roles = GLINT_SETTING_WEIGHS_ERRORS,
     .option =
         {GLINT_OPTION_CHOICE, .name = "irradiance", .argument = "KIND",
          .help =
              "The light on matte paint: exact, a map computed from the whole environment; sh, its "
              "nine spherical harmonics, which are faster, and inexact where a light is small.",
          .choices = GLINT_CHOICES("exact", "sh")}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(lights), .fingerprint = GLINT_FINGERPRINT_BY_NAME,
     .key = "lights",
     .option = {GLINT_OPTION_CHOICE, .name = "lights", .argument = "KIND",
                .help = "The point, spot and directional lights of the file: file uses them, none "
                        "leaves them out. Matte paint shows their light and shadows.",
                .choices = GLINT_CHOICES("file", "none")}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(roughness), .fingerprint = GLINT_FINGERPRINT_BY_NAME,
     .key = "roughness", .roles = GLINT_SETTING_VARIES | GLINT_SETTING_WEIGHS_ERRORS,
     .option = {GLINT_OPTION_CHOICE, .name = "roughness", .argument = "KIND",
                .help = "Quality of rough surfaces: fast, metal and paint are right to about 0.01; "
                        "exact, to about 0.003, in some three times the time; smooth, metal is a "
                        "mirror, paint reflects nothing, glass is clear.",
                .choices = GLINT_CHOICES("fast", "exact", "smooth")}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(scattering), .fingerprint = GLINT_FINGERPRINT_BY_NAME,
     .key = "scattering",
     .option = {GLINT_OPTION_CHOICE, .name = "scattering", .argument = "KIND",
                .help = "Reflections between the microfacets of rough surfaces: multiple, until "
                        "the light leaves, so white metal reflects all of it, as in three.js, "
                        "Filament and Blender; single, once, as in glTF's formulas, which darkens "
                        "rough metal.",
                .choices = GLINT_CHOICES("multiple", "single")}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(facets), .fingerprint = GLINT_FINGERPRINT_BY_NAME,
     .key = "facets", .roles = GLINT_SETTING_VARIES,
     .option = {GLINT_OPTION_INT, .name = "facets", .argument = "N",
                .help = "Directions for each pixel that shows rough glass. More directions take "
                        "more time and show fewer single images. --max-error does not choose them.",
                .minimum = 1, .maximum = GLINT_FACETS_MAX}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(wavelengths), .fingerprint = GLINT_FINGERPRINT_BY_NAME,
     .key = "wavelengths",
     .option =
         {GLINT_OPTION_INT, .name = "wavelengths", .argument = "N",
          .help =
              "Wavelengths for each pixel that shows dispersing glass: 3 are red, green and blue. "
              "More turn fringes into rainbows and take more time. 1 shows no dispersion.",
          .minimum = 1, .maximum = GLINT_WAVELENGTHS_MAX}},
    {GLINT_SETTINGS_OF_FRAME, MEMBER(shading), .fingerprint = 15, .key = "shading",
     .no_capture = "a capture shows what surfaces see of each other, which vertices do not",
     .roles = GLINT_SETTING_WEIGHS_ERRORS,
     .option = {GLINT_OPTION_CHOICE, .name = "shading", .argument = "RATE",
                .help = "Where the environment is looked up: pixel, at the surface of each pixel; "
                        "vertex-direction, along directions that are computed at vertices and "
                        "interpolated; vertex-color, at vertices, with interpolated colours. With "
                        "shading at vertices surfaces see only the environment.",
                .choices = shadings}},
    {GLINT_SETTINGS_OF_DEVICE, MEMBER(kernel_width), .key = "kernel_width",
     .option = {GLINT_OPTION_ONE_OF, .name = "kernel-width", .argument = "LANES",
                .help = "Rays in a packet, for measurements: 1, 8 or 16.",
                .fallback = "chosen for the device", .zero = "auto",
                .choices = GLINT_CHOICES("1", "8", "16")}},
    {GLINT_SETTINGS_OF_DEVICE, MEMBER(tile_packets), .key = "kernel_tile",
     .option = {GLINT_OPTION_ONE_OF, .name = "kernel-tile", .argument = "PACKETS",
                .help =
                    "Packets whose primary rays are traced together, for measurements: 1 or 16.",
                .fallback = "chosen for the device", .zero = "auto",
                .choices = GLINT_CHOICES("1", "16")}},
    {GLINT_SETTINGS_OF_DEVICE, MEMBER(kernels),
     .option = {GLINT_OPTION_CHOICE, .name = "kernels", .argument = "KIND",
                .help =
                    "special kernels contain only what the scene needs and run fastest. general "
                    "kernels serve most scenes, so they are compiled once (glint warm). Both "
                    "give the same pixels. auto takes what is compiled already, special first.",
                .fallback = "auto; special for glint bench",
                .choices = GLINT_CHOICES("auto", "special", "general")}},
    {GLINT_SETTINGS_OF_LAYERS, MEMBER(aovs), .fingerprint = 12, .roles = GLINT_SETTING_VARIES,
     .print = print_aovs,
     .option =
         {GLINT_OPTION_CUSTOM, .name = "aov", .argument = "LIST",
          .help = "Extra channels of the EXR, separated by commas, or all. Of the surface that the "
                  "primary ray meets: Z (metres along the axis of view), normal (world space), "
                  "albedo (base colour), object and material (indices in the file), triangle. Of "
                  "the paths: surfaces (that the longest path met), tir (total reflections), "
                  "truncated (weight of paths that were cut off), face (of the environment, for "
                  "the heaviest look-up). With several samples surfaces is the maximum, tir and "
                  "truncated are means, and the others belong to the middle sample.",
          .parse = parse_aovs}},
    {GLINT_SETTINGS_OF_LAYERS, MEMBER(terms), .fingerprint = 14, .roles = GLINT_SETTING_VARIES,
     .option = {GLINT_OPTION_INT, .name = "directions", .argument = "K",
                .help =
                    "Keep the K heaviest directions along which the paths of each pixel leave, "
                    "with their weights, as extra channels of the EXR. glint relight reads them.",
                .minimum = 1, .maximum = GLINT_TERMS_MAX}},
    {GLINT_SETTINGS_INTERNAL, MEMBER(output), .fingerprint = 10,
     .option = {GLINT_OPTION_CHOICE, .choices = GLINT_CHOICES("colours", "hits")}},
    {GLINT_SETTINGS_INTERNAL, MEMBER(backdrop), .fingerprint = GLINT_FINGERPRINT_BY_NAME,
     .print = print_background, .option = {GLINT_OPTION_CUSTOM, .name = "background"}},
    {GLINT_SETTINGS_INTERNAL, MEMBER(proxy), .fingerprint = 16,
     .option = {GLINT_OPTION_FLAG, .name = "proxy"}},
    {GLINT_SETTINGS_INTERNAL, MEMBER(grid_step), .fingerprint = 17, .roles = GLINT_SETTING_VARIES,
     .option = {GLINT_OPTION_INT}},
    {GLINT_SETTINGS_INTERNAL, MEMBER(truncation_squares), .roles = GLINT_SETTING_VARIES,
     .option = {GLINT_OPTION_FLAG}},
    {GLINT_SETTINGS_INTERNAL, MEMBER(all_features), .option = {GLINT_OPTION_FLAG}},
    {GLINT_SETTINGS_INTERNAL, MEMBER(build_tag), .option = {GLINT_OPTION_INT}},
};

const size_t glint_setting_count = sizeof glint_setting_table / sizeof *glint_setting_table;

const glint_exclusion glint_exclusion_table[] = {
    {OF(samples_per_axis), OF(output), "are of one sample a pixel"},
    {OF(aovs), OF(output), "have no paths"},
    {OF(terms), OF(output), "have no paths"},
    {OF(terms), OF(filter), "needs what a pixel sees around a direction, which is not kept"},
    {OF(filter), OF(shading), "shades vertices, which see no part of the environment"},
    {OF(aovs), OF(shading), "shades vertices, and layers tell of pixels"},
    {OF(terms), OF(shading), "shades vertices, and directions are kept of pixels"},
    {OF(terms), OF(backdrop), "keeps directions, and a colour comes from none"},
    {OF(proxy), OF(filter), "takes more than points, for which alone rays find a proxy"},
    {OF(proxy), OF(terms), "keeps directions, and places are what a proxy needs"},
    {OF(proxy), OF(shading), "shades vertices, and pixels are what a proxy is found for"},
    // Mending replaces single precision with double precision.
    {OF(mend), OF(precision), "has nothing to mend"},
    {OF(mend), OF(shading), "has nothing to mend"},
    {OF(mend), OF(output), "have nothing to mend"},
};

const size_t glint_exclusion_count = sizeof glint_exclusion_table / sizeof *glint_exclusion_table;

const char *glint_shading_name(glint_shading shading)
{
    return shadings[shading];
}

// ---- Reading the table -------------------------------------------------------------------------

const glint_setting *glint_setting_at(size_t offset)
{
    const glint_setting *setting = glint_setting_table;
    while (setting->offset != offset) {
        setting++;
    }
    return setting;
}

size_t glint_setting_destination(const glint_setting *setting)
{
    return setting->option.kind == GLINT_OPTION_CUSTOM ? 0 : setting->offset;
}

// False if the default is out of range, as 0 directions are: leaving the option out then gives the
// default.
static bool has_a_default(const glint_setting *setting)
{
    const glint_option *option = &setting->option;
    const double usual = glint_setting_number(setting, &glint_settings_default, 0);
    return option->kind != GLINT_OPTION_INT || option->zero != NULL || usual >= option->minimum;
}

bool glint_settings_option(glint_settings_group group, size_t index, size_t offset,
                           glint_option *option, char text[GLINT_SETTING_TEXT])
{
    const glint_setting *end = glint_setting_table + glint_setting_count;
    const glint_setting *setting = glint_setting_table;
    while (setting < end && (setting->group != group || index-- > 0)) {
        setting++;
    }
    if (setting == end) {
        return false;
    }
    *option = setting->option;
    option->offset = offset + glint_setting_destination(setting);
    glint_setting_print(setting, &glint_settings_default, text);
    if (option->fallback == NULL && has_a_default(setting) && text[0] != '\0') {
        option->fallback = text;
    }
    return true;
}

static size_t size_of_type(glint_setting_type type)
{
    static const size_t sizes[] = {
        [GLINT_SETTING_BOOL] = sizeof(bool),
        [GLINT_SETTING_INT] = sizeof(int),
        [GLINT_SETTING_UNSIGNED] = sizeof(unsigned),
        [GLINT_SETTING_REAL] = sizeof(double),
    };
    return sizes[type];
}

size_t glint_setting_number_count(const glint_setting *setting)
{
    return setting->size / size_of_type(setting->type);
}

double glint_setting_number(const glint_setting *setting, const glint_settings *settings, size_t i)
{
    const void *member = (const char *)settings + setting->offset;
    switch (setting->type) {
    case GLINT_SETTING_BOOL:
        return ((const bool *)member)[i] ? 1 : 0;
    case GLINT_SETTING_INT:
        return ((const int *)member)[i];
    case GLINT_SETTING_UNSIGNED:
        return ((const unsigned *)member)[i];
    case GLINT_SETTING_REAL:
        return ((const double *)member)[i];
    }
    return 0;
}

bool glint_setting_differs(const glint_setting *setting, const glint_settings *a,
                           const glint_settings *b)
{
    bool differs = false; // compared as numbers: 0 equals −0, NaN equals nothing
    for (size_t i = 0; i < glint_setting_number_count(setting); i++) {
        differs |= glint_setting_number(setting, a, i) != glint_setting_number(setting, b, i);
    }
    return differs;
}

const glint_setting *glint_settings_find_changed(const glint_settings *settings, unsigned roles)
{
    for (size_t i = 0; i < glint_setting_count; i++) {
        const glint_setting *setting = &glint_setting_table[i];
        if ((setting->roles & roles) != 0 &&
            glint_setting_differs(setting, settings, &glint_settings_default)) {
            return setting;
        }
    }
    return NULL;
}

void glint_setting_print(const glint_setting *setting, const glint_settings *settings,
                         char text[GLINT_SETTING_TEXT])
{
    const glint_option *option = &setting->option;
    const double number = glint_setting_number(setting, settings, 0);
    if (setting->print != NULL) {
        setting->print(settings, text);
    } else if (option->kind == GLINT_OPTION_SIZE) {
        snprintf(text, GLINT_SETTING_TEXT, "%dx%d", settings->width, settings->height);
    } else if (option->zero != NULL && number == 0) {
        snprintf(text, GLINT_SETTING_TEXT, "%s", option->zero);
    } else if (option->kind == GLINT_OPTION_CHOICE) {
        size_t count = 0;
        while (option->choices[count] != NULL) {
            count++;
        }
        snprintf(text, GLINT_SETTING_TEXT, "%s",
                 number < (double)count ? option->choices[(size_t)number] : "unknown");
    } else {
        print_real(number, text);
    }
}

void glint_setting_print_name(const glint_setting *setting, const glint_settings *settings,
                              char text[GLINT_SETTING_TEXT])
{
    const glint_option *option = &setting->option;
    char value[GLINT_SETTING_TEXT];
    glint_setting_print(setting, settings, value);
    const bool is_word = option->kind == GLINT_OPTION_CHOICE || option->kind == GLINT_OPTION_CUSTOM;
    if (option->name == NULL) {
        snprintf(text, GLINT_SETTING_TEXT, "%s", value);
    } else {
        snprintf(text, GLINT_SETTING_TEXT, "--%s%s%.100s", option->name, is_word ? " " : "",
                 is_word ? value : "");
    }
}
