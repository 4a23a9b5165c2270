// Look-ups of textures as frames show them, against look-ups in double precision that this file
// makes by itself, from the texels that it wrote: a plane that glows with its texture, seen at a
// slant.
#include "support/render.h"
#include "support/scratch.h"
#include "support/textured_plane.h"

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

static void fill_picture(picture *p)
{
    p->levels = 1;
    while (side(p->width, p->levels - 1) > 1 || side(p->height, p->levels - 1) > 1) {
        p->levels++;
    }
    for (int i = 0; i < p->width * p->height; i++) {
        for (int c = 0; c < CHANNELS; c++) {
            const double code = p->codes[i][c] / 255.0;
            p->texels[0][i][c] = c < 3 ? srgb_of_code(code) : code;
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
    fill_picture(p);
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
    const double width = at->length * 2 * tan(PLANE_YFOV / 2) / settings->height / at->slant;
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
        if (!textured_plane_meet(settings, i, &m)) {
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
        write_codes("a.png", (const int[]){p->width, p->height},
                    (const unsigned char(*)[4])p->codes);
        glint_scene scene = textured_plane_load(
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(textures_are_looked_up_as_the_samplers_say, scratch_setup,
                                        scratch_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
