// Textures as frames show them, against look-ups in double precision that this file makes by
// itself, from the texels that it wrote: a plane that glows with its texture, seen at a slant. Then
// the slots: a texture of one value is a factor of that value. Then normals and alpha.
#include "image/color.h"
#include "image/image_io.h"
#include "support/bridge.h"
#include "support/gltf_text.h"
#include "support/render.h"
#include "support/scratch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { LARGEST = 32, LEVELS = 6, CHANNELS = 4 };

// ---- Images -------------------------------------------------------------------------------------

// 8-bit codes, and what they mean: levels of linear values, each from the last.
typedef struct picture {
    int width, height, levels;
    unsigned char codes[LARGEST * LARGEST][CHANNELS];
    double texels[LEVELS][LARGEST * LARGEST][CHANNELS];
} picture;

static int side(int size, int level)
{
    return size >> level > 1 ? size >> level : 1;
}

static double srgb(double code)
{
    return code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
}

// How much of the interval [i, i + 1] lies within [low, high].
static double overlap(int i, double low, double high)
{
    return fmax(0, fmin(i + 1, high) - fmax(i, low));
}

// The area mean of a level: texels of the coarser one cover parts of those of the finer one.
static double area_mean(const picture *p, int level, const int at[2], int channel)
{
    const int w = side(p->width, level - 1), h = side(p->height, level - 1);
    const double across = (double)w / side(p->width, level),
                 down = (double)h / side(p->height, level);
    double sum = 0, area = 0;
    for (int y = 0; y < h; y++) {
        for (int x = 0; x < w; x++) {
            const double share = overlap(x, at[0] * across, (at[0] + 1) * across) *
                                 overlap(y, at[1] * down, (at[1] + 1) * down);
            sum += share * p->texels[level - 1][y * w + x][channel];
            area += share;
        }
    }
    return sum / area;
}

static void fill_picture(picture *p, bool is_color)
{
    p->levels = 1;
    while (side(p->width, p->levels - 1) > 1 || side(p->height, p->levels - 1) > 1) {
        p->levels++;
    }
    for (int i = 0; i < p->width * p->height; i++) {
        for (int c = 0; c < CHANNELS; c++) {
            const double code = p->codes[i][c] / 255.0;
            p->texels[0][i][c] = is_color && c < 3 ? srgb(code) : code;
        }
    }
    for (int level = 1; level < p->levels; level++) {
        for (int y = 0; y < side(p->height, level); y++) {
            for (int x = 0; x < side(p->width, level); x++) {
                for (int c = 0; c < CHANNELS; c++) {
                    p->texels[level][y * side(p->width, level) + x][c] =
                        area_mean(p, level, (const int[]){x, y}, c);
                }
            }
        }
    }
}

// Codes that differ from texel to texel, smooth enough that an error of place shows as one of
// value.
static void make_picture(int width, int height, picture *p)
{
    *p = (picture){.width = width, .height = height};
    for (int i = 0; i < width * height; i++) {
        for (int c = 0; c < CHANNELS; c++) {
            p->codes[i][c] = (unsigned char)(40 + (i * (37 + 20 * c) + 11 * c) % 200);
        }
    }
    fill_picture(p, true);
}

// Writes the codes as NAME, a PNG with alpha.
static void write_picture(const picture *p, const char *name)
{
    glint_image image;
    assert_int_equal(glint_image_create(p->width, p->height, 4, &image, NULL), GLINT_OK);
    for (int i = 0; i < p->width * p->height; i++) {
        const float alpha = (float)p->codes[i][3] / 255.0F;
        for (int c = 0; c < 3; c++) {
            image.pixels[4 * i + c] = alpha * (float)srgb(p->codes[i][c] / 255.0);
        }
        image.pixels[4 * i + 3] = alpha;
    }
    assert_int_equal(glint_image_write(scratch_path(name), &image, NULL, NULL), GLINT_OK);
    glint_image_free(&image);
}

// ---- The look-up --------------------------------------------------------------------------------

typedef struct sampler {
    const char *json;
    int wrap[2]; // 0 repeat, 1 clamp, 2 mirror
    bool magnified_nearest, minified_nearest;
    int mips; // 0 linear, 1 nearest, 2 none
} sampler;

static int wrap(int i, int size, int how)
{
    const int period = how == 2 ? 2 * size : size;
    if (how == 1) {
        return i < 0 ? 0 : i >= size ? size - 1 : i;
    }
    i = ((i % period) + period) % period;
    return i >= size ? period - 1 - i : i;
}

// How a level is looked up.
typedef struct level_use {
    int level;
    bool nearest;
} level_use;

static void look_up_level(const picture *p, const sampler *s, level_use use, const double uv[2],
                          double rgba[4])
{
    const int level = use.level;
    const int w = side(p->width, level), h = side(p->height, level);
    const double x = uv[0] * w - 0.5, y = uv[1] * h - 0.5;
    const int i = (int)floor(x), j = (int)floor(y);
    double right = x - i, down = y - j;
    if (use.nearest) {
        right = right >= 0.5;
        down = down >= 0.5;
    }
    memset(rgba, 0, 4 * sizeof *rgba);
    for (int corner = 0; corner < 4; corner++) {
        const int a = corner & 1, b = corner >> 1;
        const double weight = (a ? right : 1 - right) * (b ? down : 1 - down);
        const int texel = wrap(j + b, h, s->wrap[1]) * w + wrap(i + a, w, s->wrap[0]);
        for (int c = 0; c < 4; c++) {
            rgba[c] += weight * p->texels[level][texel][c];
        }
    }
}

// `texels`: how many a pixel sees, along the longer axis of its ellipse. ARCHITECTURE.md,
// "Textures", has the rule.
static void look_up(const picture *p, const sampler *s, const double uv[2], double texels,
                    double rgba[4])
{
    const int last = s->mips == 2 ? 0 : p->levels - 1;
    const bool magnified = !(texels > 1);
    texels = fmin(fmax(texels, 1), (double)(1 << last));
    int level = (int)floor(log2(texels));
    double blend = texels / (1 << level) - 1;
    if (s->mips == 1) {
        level += blend >= 0.5;
        blend = 0;
    }
    const bool nearest = magnified ? s->magnified_nearest : s->minified_nearest;
    double next[4];
    look_up_level(p, s, (level_use){level, nearest}, uv, rgba);
    if (blend > 0) {
        look_up_level(p, s, (level_use){level + 1, nearest}, uv, next);
        for (int c = 0; c < 4; c++) {
            rgba[c] += blend * (next[c] - rgba[c]);
        }
    }
}

// ---- A plane ------------------------------------------------------------------------------------

// Two triangles in the plane y = 0 from (−4, 0, 2) to (4, 0, −14): u runs along +x, v along +z;
// 0 to 2 in set 0, and in set 1 half as much, the other way round.
typedef struct plane {
    float positions[4][3], normals[4][3], first[4][2], second[4][2], tangents[4][4], colors[4][4];
    uint16_t indices[6];
} plane;

static const plane the_plane = {
    .positions = {{-4, 0, 2}, {4, 0, 2}, {4, 0, -14}, {-4, 0, -14}},
    .normals = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}},
    .first = {{0, 2}, {2, 2}, {2, 0}, {0, 0}},
    .second = {{1, 0}, {0, 0}, {0, 1}, {1, 1}},
    .tangents = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}},
    .colors = {{1, 0.5F, 0.25F, 1}, {1, 0.5F, 0.25F, 1}, {0.5F, 1, 0.25F, 1}, {0.5F, 1, 0.25F, 1}},
    .indices = {0, 1, 2, 0, 2, 3}};

#define YFOV 0.8
#define PLANE                                                                                      \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"                                           \
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":48},"                                          \
    "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":32},"                                          \
    "{\"buffer\":0,\"byteOffset\":128,\"byteLength\":32},"                                         \
    "{\"buffer\":0,\"byteOffset\":160,\"byteLength\":64},"                                         \
    "{\"buffer\":0,\"byteOffset\":224,\"byteLength\":64},"                                         \
    "{\"buffer\":0,\"byteOffset\":288,\"byteLength\":12}],"                                        \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"      \
    "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"                     \
    "{\"bufferView\":2,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"                     \
    "{\"bufferView\":3,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"                     \
    "{\"bufferView\":4,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"},"                     \
    "{\"bufferView\":5,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"},"                     \
    "{\"bufferView\":6,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}],"                  \
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.8,\"znear\":1}}],"         \
    "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},"                                      \
    "{\"camera\":0,\"translation\":[0,1.5,3],\"rotation\":[-0.19866933,0,0,0.98006658]}],"
#define MESH(more)                                                                                 \
    "\"meshes\":[{\"primitives\":[{\"indices\":6,\"material\":0,\"attributes\":{\"POSITION\":0,"   \
    "\"NORMAL\":1,\"TEXCOORD_0\":2,\"TEXCOORD_1\":3" more "}}]}],"
#define UNLIT "\"extensions\":{\"KHR_materials_unlit\":{}}"
#define ONE_TEXTURE(file)                                                                          \
    "\"images\":[{\"uri\":\"" file "\"}],\"textures\":[{\"source\":0,\"sampler\":0}],"

// The plane with a mesh, a material and what else `format` says.
static glint_scene load_plane(const char *folder, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static glint_scene load_plane(const char *folder, const char *format, ...)
{
    char rest[6000] = PLANE;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(rest + strlen(rest), sizeof rest - strlen(rest), format, arguments);
    va_end(arguments);
    return load_rest(folder, &the_plane, sizeof the_plane, rest);
}

// Where the primary ray through a pixel's centre meets the plane.
typedef struct meeting {
    double at[2];          // x and z
    double length, cosine; // of the way; against the plane's normal
    double slant;          // how long the ray is where it has come 1 forwards
} meeting;

// False where it does not.
static bool meet_plane(const glint_settings *settings, int pixel, meeting *m)
{
    const int column = pixel % settings->width, row = pixel / settings->width;
    const double half = tan(YFOV / 2), turn = -2 * asin(0.19866933);
    const double x =
        (2 * (column + 0.5) / settings->width - 1) * half * settings->width / settings->height;
    const double y = (1 - 2 * (row + 0.5) / settings->height) * half;
    const double d[3] = {x, y * cos(turn) + sin(turn), y * sin(turn) - cos(turn)};
    const double norm = sqrt(x * x + y * y + 1);
    const double t = -1.5 / d[1];
    *m = (meeting){
        .at = {t * d[0], 3 + t * d[2]}, .length = t * norm, .cosine = -d[1] / norm, .slant = norm};
    return t > 0 && fabs(m->at[0]) < 4 && m->at[1] < 2 && m->at[1] > -14;
}

// ---- Look-ups -----------------------------------------------------------------------------------

typedef struct lookup_case {
    int width, height;
    sampler sampler;
    const char *info; // members of the textureInfo, each with a comma before it
    double transform[6];
    int set;
    double tolerance;
} lookup_case;

#define AS_IT_IS                                                                                   \
    {                                                                                              \
        1, 0, 0, 0, 1, 0                                                                           \
    }
// Single precision places a point within some 2⁻²² of a texture coordinate of 2, and neighbouring
// texels differ by 0.8 at most: with 32 texels that is an error of 6e-6. Texels are rounded to
// 1/65535 once for each level, which is 8e-6 each time and partly evens out.
#define BILINEAR 2e-5
// Where texels are taken whole, a point near their edge may fall on the other side: not compared.
#define WHOLE 2e-5

static const lookup_case cases[] = {
    {32, 32, {"{}", {0, 0}, false, false, 0}, "", AS_IT_IS, 0, BILINEAR},
    {31,
     17,
     {"{\"wrapS\":33648,\"wrapT\":33071}", {2, 1}, false, false, 0},
     "",
     AS_IT_IS,
     0,
     BILINEAR},
    {1,
     7,
     {"{\"wrapS\":33071,\"wrapT\":33648}", {1, 2}, false, false, 0},
     "",
     AS_IT_IS,
     0,
     BILINEAR},
    {32, 16, {"{\"minFilter\":9985}", {0, 0}, false, false, 1}, "", AS_IT_IS, 0, BILINEAR},
    {32, 32, {"{\"minFilter\":9729}", {0, 0}, false, false, 2}, "", AS_IT_IS, 0, BILINEAR},
    {8,
     8,
     {"{\"magFilter\":9728,\"minFilter\":9728}", {0, 0}, true, true, 2},
     "",
     AS_IT_IS,
     0,
     WHOLE},
    {16, 16, {"{\"minFilter\":9986}", {0, 0}, false, true, 0}, "", AS_IT_IS, 0, WHOLE},
    {16, 8, {"{}", {0, 0}, false, false, 0}, ",\"texCoord\":1", AS_IT_IS, 1, BILINEAR},
    {32,
     32,
     {"{}", {0, 0}, false, false, 0},
     ",\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.25,0.5],\"rotation\":0.5,"
     "\"scale\":[1.5,0.75],\"texCoord\":0}},\"texCoord\":1",
     {0.8775825618903728 * 1.5, 0.479425538604203 * 0.75, 0.25, -0.479425538604203 * 1.5,
      0.8775825618903728 * 0.75, 0.5},
     0,
     2 * BILINEAR},
};

// How near a point is to a place where something jumps: in texels of the finest level that it
// takes, and in levels.
static bool is_clear(const lookup_case *c, const picture *p, const double uv[2], double texels)
{
    const sampler *s = &c->sampler;
    const double octave = texels > 1 ? log2(texels) : 0;
    if (fabs(texels - 1) < 1e-4 ||
        (s->mips == 1 && fabs(texels / exp2(floor(octave)) - 1.5) < 1e-3)) {
        return false;
    }
    if (!s->magnified_nearest && !s->minified_nearest) {
        return true;
    }
    for (int level = 0; level < p->levels; level++) {
        const double x = uv[0] * side(p->width, level), y = uv[1] * side(p->height, level);
        if (fabs(x - round(x)) < 1e-3 || fabs(y - round(y)) < 1e-3) {
            return false;
        }
    }
    return true;
}

// How many texels of the finest level a pixel sees along the longer axis of its ellipse. The axes
// run across the ray's way, and along it.
static double texels_seen(const lookup_case *c, const picture *p, const glint_settings *settings,
                          const meeting *at)
{
    const double center[2] = {at->at[0], at->at[1] - 3}, far = hypot(center[0], center[1]);
    // The width of the cone grows with the distance along the ray of the pixel's own length.
    const double width = at->length * 2 * tan(YFOV / 2) / settings->height / at->slant;
    const double *m = c->transform;
    double longest = 0;
    for (int axis = 0; axis < 2; axis++) {
        const double e[2] = {axis ? center[0] / far : -center[1] / far,
                             axis ? center[1] / far : center[0] / far};
        const double size = (axis ? width / at->cosine : width) * (c->set ? -0.5 : 1);
        const double du = size * e[0] / 4, dv = size * e[1] / 8;
        longest = fmax(longest, hypot((m[0] * du + m[1] * dv) * p->width,
                                      (m[3] * du + m[4] * dv) * p->height));
    }
    return longest;
}

static void moved_point(const lookup_case *c, const meeting *m, double uv[2])
{
    const double first[2] = {(m->at[0] + 4) / 4, (m->at[1] + 14) / 8};
    const double u = c->set ? 1 - first[0] / 2 : first[0];
    const double v = c->set ? 1 - first[1] / 2 : first[1];
    const double *t = c->transform;
    uv[0] = t[0] * u + t[1] * v + t[2];
    uv[1] = t[3] * u + t[4] * v + t[5];
}

// The largest error of a frame's pixels; counts those that were compared.
static double largest_error(const lookup_case *c, const picture *p, const test_frame *frame,
                            const glint_settings *settings, int *compared)
{
    double worst = 0;
    for (int i = 0; i < settings->width * settings->height; i++) {
        meeting m;
        if (!meet_plane(settings, i, &m)) {
            continue;
        }
        double uv[2], rgba[4];
        moved_point(c, &m, uv);
        const double texels = texels_seen(c, p, settings, &m);
        if (!is_clear(c, p, uv, texels)) {
            continue;
        }
        look_up(p, &c->sampler, uv, texels, rgba);
        for (int k = 0; k < 3; k++) {
            worst = fmax(worst, fabs(frame->exact[4 * i + k] - rgba[k]));
        }
        (*compared)++;
    }
    return worst;
}

static void textures_are_looked_up_as_the_samplers_say(void **state)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const lookup_case *c = &cases[i];
        picture *p = malloc(sizeof *p);
        assert_non_null(p);
        make_picture(c->width, c->height, p);
        write_picture(p, "a.png");
        glint_scene scene = load_plane(
            *state,
            MESH("") ONE_TEXTURE("a.png") "\"samplers\":[%s],\"materials\":[{" UNLIT
                                          ",\"pbrMetallicRoughness\":{\"baseColorTexture\":"
                                          "{\"index\":0%s}}}]",
            c->sampler.json, c->info);
        for (int precision = 0; precision < 2; precision++) {
            glint_settings settings = test_small_frame(1);
            settings.precision = precision ? GLINT_PRECISION_DOUBLE : GLINT_PRECISION_FLOAT;
            test_frame frame;
            test_render(&scene, test_studio(), NULL, &settings, &frame);
            int compared = 0;
            const double worst = largest_error(c, p, &frame, &settings, &compared);
            // In double precision the rounding of texels to 1/65535 is left, once for each level.
            const double tolerance = precision ? 1.5e-5 : c->tolerance;
            if (!(worst <= tolerance) || compared < 1000) {
                fail_msg("case %zu, precision %d: %g, %d compared", i, precision, worst, compared);
            }
            test_frame_free(&frame);
        }
        glint_scene_free(&scene);
        free(p);
    }
}

// ---- Slots --------------------------------------------------------------------------------------

// A picture of one texel.
static void write_texel(const char *name, int r, int g, int b, int a)
{
    picture p = {.width = 1, .height = 1};
    const int codes[4] = {r, g, b, a};
    for (int c = 0; c < 4; c++) {
        p.codes[0][c] = (unsigned char)codes[c];
    }
    write_picture(&p, name);
}

typedef struct slot_case {
    const char *textured, *plain; // members of the material
} slot_case;

#define TEXTURE "{\"index\":0}"
// The texel is (51, 102, 204, 255): data 0.2, 0.4, 0.8; colour 0.0331, 0.1329, 0.6038.
#define COLOR "0.033104766570885055,0.13286832155381798,0.603827338855338"

static const slot_case slots[] = {
    {"\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorTexture\":" TEXTURE "}",
     "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":[" COLOR ",1]}"},
    {"\"pbrMetallicRoughness\":{\"roughnessFactor\":0,\"metallicRoughnessTexture\":" TEXTURE "}",
     "\"pbrMetallicRoughness\":{\"roughnessFactor\":0,\"metallicFactor\":0.8}"},
    {"\"emissiveFactor\":[1,0.5,1],\"emissiveTexture\":" TEXTURE,
     "\"emissiveFactor\":[0.033104766570885055,0.06643416077690899,0.603827338855338]"},
    {"\"pbrMetallicRoughness\":{\"metallicFactor\":0},\"occlusionTexture\":{\"index\":0,"
     "\"strength\":0.5}",
     "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":[0.6,0.6,0.6,1]}"},
    {"\"pbrMetallicRoughness\":{\"metallicFactor\":0},\"extensions\":{"
     "\"KHR_materials_transmission\":{\"transmissionFactor\":0.5,\"transmissionTexture\":" TEXTURE
     "}}",
     "\"pbrMetallicRoughness\":{\"metallicFactor\":0},\"extensions\":{"
     "\"KHR_materials_transmission\":{\"transmissionFactor\":0.1}}"},
    // A normal that stands upright bends nothing.
    {"\"pbrMetallicRoughness\":{\"roughnessFactor\":0},\"normalTexture\":{\"index\":1,"
     "\"scale\":0}",
     "\"pbrMetallicRoughness\":{\"roughnessFactor\":0}"},
};

static double largest_difference(const test_frame *a, const test_frame *b, int pixels)
{
    double worst = 0;
    for (int i = 0; i < 4 * pixels; i++) {
        worst = fmax(worst, fabs(a->exact[i] - b->exact[i]) / (1 + fabs(b->exact[i])));
    }
    return worst;
}

static void render_plane(glint_scene scene, const glint_settings *settings, test_frame *frame)
{
    test_render(&scene, test_studio(), NULL, settings, frame);
    glint_scene_free(&scene);
}

static void a_texture_of_one_value_is_a_factor(void **state)
{
    write_texel("a.png", 51, 102, 204, 255);
    write_texel("b.png", 128, 128, 255, 255);
    const glint_settings settings = test_small_frame(2);
    for (size_t i = 0; i < sizeof slots / sizeof *slots; i++) {
        test_frame textured, plain;
        render_plane(load_plane(*state,
                                MESH("") "\"images\":[{\"uri\":\"a.png\"},{\"uri\":\"b.png\"}],"
                                         "\"textures\":[{\"source\":0},{\"source\":1}],"
                                         "\"materials\":[{%s}]",
                                slots[i].textured),
                     &settings, &textured);
        render_plane(load_plane(*state, MESH("") "\"materials\":[{%s}]", slots[i].plain), &settings,
                     &plain);
        const double worst = largest_difference(&textured, &plain, 61 * 43);
        // Texels are rounded to 1/65535, and factors to floats.
        if (!(worst < 2e-5)) {
            fail_msg("slot %zu: %g", i, worst);
        }
        test_frame_free(&textured);
        test_frame_free(&plain);
    }
}

static void colors_of_vertices_multiply_the_base_color(void **state)
{
    const glint_settings settings = test_small_frame(1);
    test_frame frame;
    render_plane(load_plane(*state, MESH(",\"COLOR_0\":5") "\"materials\":[{" UNLIT
                                                           ",\"pbrMetallicRoughness\":{"
                                                           "\"baseColorFactor\":[1,0.5,1,1]}}]"),
                 &settings, &frame);
    for (int i = 0; i < 61 * 43; i++) {
        meeting m;
        if (meet_plane(&settings, i, &m)) {
            const double far = (2 - m.at[1]) / 16; // 0 in front
            const double expected[3] = {1 - far / 2, 0.25 + far / 4, 0.25};
            for (int k = 0; k < 3; k++) {
                assert_true(fabs(frame.exact[4 * i + k] - expected[k]) < 2e-6);
            }
        }
    }
    test_frame_free(&frame);
}

// ---- Normals ------------------------------------------------------------------------------------

// The direction that a mirror shows whose normal is bent by (x, y) of a normal texture.
static void bent_normals_turn_reflections(void **state)
{
    write_texel("n.png", 178, 89, 230, 255); // x = 0.396, y = −0.302, z = 0.804
    const double raw[3] = {2 * 178 / 255.0 - 1, 2 * 89 / 255.0 - 1, 2 * 230 / 255.0 - 1};
    glint_environment directions;
    bridge_direction_environment(32, &directions);
    static const char *const tangents[] = {",\"TANGENT\":4", ""}; // of the file; as computed
    for (int from_file = 0; from_file < 2; from_file++) {
        glint_scene scene = load_plane(
            *state,
            "\"meshes\":[{\"primitives\":[{\"indices\":6,\"material\":0,\"attributes\":{"
            "\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2%s}}]}],\"images\":[{\"uri\":\"n.png\"}],"
            "\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":{"
            "\"roughnessFactor\":0},\"normalTexture\":{\"index\":0,\"scale\":0.5}}]",
            tangents[from_file]);
        glint_settings settings = test_small_frame(1);
        test_frame frame;
        test_render(&scene, &directions, NULL, &settings, &frame);
        // Tangent +x, bitangent where v falls: −z, normal +y.
        const double length = sqrt(raw[0] * raw[0] / 4 + raw[1] * raw[1] / 4 + raw[2] * raw[2]);
        const double n[3] = {raw[0] / 2 / length, raw[2] / length, -raw[1] / 2 / length};
        int compared = 0;
        for (int i = 0; i < 61 * 43; i++) {
            meeting m;
            if (!meet_plane(&settings, i, &m)) {
                continue;
            }
            const double v[3] = {-m.at[0] / m.length, 1.5 / m.length, (3 - m.at[1]) / m.length};
            const double along = v[0] * n[0] + v[1] * n[1] + v[2] * n[2];
            double r[3];
            for (int k = 0; k < 3; k++) {
                r[k] = 2 * along * n[k] - v[k];
            }
            if (along < 0 || r[1] < 0) {
                continue; // folded, which tests/test_frame.c judges
            }
            for (int k = 0; k < 3; k++) {
                // Within what 32 texels a face make of a direction.
                assert_true(fabs(frame.exact[4 * i + k] - (0.5 + 0.5 * r[k])) < 2e-3);
            }
            compared++;
        }
        assert_true(compared > 500);
        test_frame_free(&frame);
        glint_scene_free(&scene);
    }
    glint_environment_free(&directions);
}

// ---- Alpha --------------------------------------------------------------------------------------

// A second plane a little under the first, which glows; the first is there in part.
#define TWO_PLANES(material)                                                                       \
    "\"meshes\":[{\"primitives\":[{\"indices\":6,\"material\":0,\"attributes\":{\"POSITION\":0,"   \
    "\"TEXCOORD_0\":2}}]},{\"primitives\":[{\"indices\":6,\"material\":1,\"attributes\":{"         \
    "\"POSITION\":0}}]}],\"materials\":[{" material "},{" UNLIT                                    \
    ",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0.25,1,1]}}]"

static glint_scene load_two(const char *folder, const char *material, bool with_second)
{
    char rest[6000];
    snprintf(rest, sizeof rest, PLANE TWO_PLANES("%s"), material);
    char *nodes = strstr(rest, "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},");
    assert_non_null(nodes);
    char tail[6000];
    snprintf(tail, sizeof tail, "%s", strstr(nodes, "{\"camera\":0"));
    sprintf(nodes, "\"scenes\":[{\"nodes\":[0,1%s]}],\"nodes\":[{\"mesh\":0},",
            with_second ? ",2" : "");
    char *end = strstr(tail, "}],");
    assert_non_null(end);
    const size_t used = strlen(rest);
    snprintf(rest + used, sizeof rest - used, "%.*s},{\"mesh\":1,\"translation\":[0,-0.25,0]}%s",
             (int)(end - tail), tail, end + 1);
    return load_rest(folder, &the_plane, sizeof the_plane, rest);
}

typedef struct alpha_case {
    const char *material;
    double share; // of the first plane, unlit (1, 0.5, 0)
} alpha_case;

#define RED(alpha) UNLIT ",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.5,0," alpha "]}"

static const alpha_case alphas[] = {
    {RED("0.25"), 1},
    {RED("0.25") ",\"alphaMode\":\"BLEND\"", 0.25},
    {RED("0") ",\"alphaMode\":\"BLEND\"", 0},
    {RED("0.25") ",\"alphaMode\":\"MASK\"", 0},
    {RED("0.5") ",\"alphaMode\":\"MASK\"", 1},
    {RED("0.25") ",\"alphaMode\":\"MASK\",\"alphaCutoff\":0.2", 1},
    {RED("1") ",\"alphaMode\":\"MASK\",\"alphaCutoff\":1.5", 0},
};

// A pixel of the near part, where both planes are seen.
enum { NEAR_PIXEL = 61 * 33 + 30 };

static void what_is_there_in_part_lets_light_pass(void **state)
{
    for (size_t i = 0; i < sizeof alphas / sizeof *alphas; i++) {
        for (int depth = 1; depth < 3; depth++) {
            const glint_settings settings = test_small_frame(depth);
            test_frame frame;
            render_plane(load_two(*state, alphas[i].material, true), &settings, &frame);
            const double share = alphas[i].share;
            const double expected[3] = {share, share * 0.5 + (1 - share) * 0.25, 1 - share};
            for (int k = 0; k < 3; k++) {
                if (!(fabs(frame.exact[4 * NEAR_PIXEL + k] - expected[k]) < 1e-6)) {
                    fail_msg("case %zu, depth %d: %g, not %g", i, depth,
                             frame.exact[4 * NEAR_PIXEL + k], expected[k]);
                }
            }
            test_frame_free(&frame);
        }
    }
}

static void alpha_is_kept_where_the_background_is_left_out(void **state)
{
    for (size_t i = 0; i < sizeof alphas / sizeof *alphas; i++) {
        glint_settings settings = test_small_frame(0);
        settings.transparent = true;
        test_frame frame;
        render_plane(load_two(*state, alphas[i].material, false), &settings, &frame);
        const double share = alphas[i].share;
        const double expected[4] = {share, share * 0.5, 0, share};
        for (int k = 0; k < 4; k++) {
            if (!(fabs(frame.exact[4 * NEAR_PIXEL + k] - expected[k]) < 1e-6)) {
                fail_msg("case %zu, channel %d: %g, not %g", i, k, frame.exact[4 * NEAR_PIXEL + k],
                         expected[k]);
            }
        }
        assert_true(frame.exact[3] == 0); // above the horizon
        test_frame_free(&frame);
    }
}

// ---- What is refused, and what stands in --------------------------------------------------------

static void unreadable_textures_become_grey_paint(void **state)
{
    scratch_write("broken.png", "\x89PNG\r\n\x1a\nnothing more", -1);
    static const char *const images[] = {"broken.png", "missing.png"};
    for (int i = 0; i < 2; i++) {
        char rest[6000];
        snprintf(rest, sizeof rest,
                 PLANE MESH("") "\"images\":[{\"uri\":\"%s\"}],\"textures\":[{\"source\":0}],"
                                "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":"
                                "{\"index\":0}}}]",
                 images[i]);
        char *text = gltf_text(&the_plane, sizeof the_plane, rest);
        glint_scene scene;
        glint_warnings warnings = {0};
        glint_error error = {0};
        assert_int_equal(load_text(*state, text, &scene, &warnings, &error), GLINT_OK);
        assert_true(any_warning_has(&warnings, "materials[0]: baseColorTexture: images[0] \""));
        assert_true(any_warning_has(&warnings, "; the surface is rendered as grey paint"));
        assert_true(scene.materials[0].metallic == 0 && scene.materials[0].base_color[1] == 0.5F);
        assert_int_equal(scene.materials[0].textures[GLINT_TEXTURE_BASE_COLOR].image, 0);
        glint_scene_free(&scene);
        glint_warnings_free(&warnings);
        free(text);
    }
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_setup, scratch_teardown)
    const struct CMUnitTest tests[] = {
        TEST(textures_are_looked_up_as_the_samplers_say),
        TEST(a_texture_of_one_value_is_a_factor),
        TEST(colors_of_vertices_multiply_the_base_color),
        TEST(bent_normals_turn_reflections),
        TEST(what_is_there_in_part_lets_light_pass),
        TEST(alpha_is_kept_where_the_background_is_left_out),
        TEST(unreadable_textures_become_grey_paint),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
