// Computes the levels of images and looks them up. See texture.h.
#include "oracle/texture.h"

#include <math.h>
#include <stdlib.h>

int oracle_image_side(int size, int level)
{
    return size >> level > 1 ? size >> level : 1;
}

bool oracle_image_create(int width, int height, oracle_image *image)
{
    *image = (oracle_image){.width = width, .height = height};
    size_t first[ORACLE_LEVELS] = {0}, count = 0;
    int w, h;
    do {
        first[image->levels] = count;
        w = oracle_image_side(width, image->levels);
        h = oracle_image_side(height, image->levels++);
        count += (size_t)w * (size_t)h;
    } while (image->levels < ORACLE_LEVELS && (w != 1 || h != 1));
    image->texels[0] = calloc(count, sizeof *image->texels[0]);
    for (int level = 1; image->texels[0] && level < image->levels; level++)
        image->texels[level] = image->texels[0] + first[level];
    return image->texels[0] != NULL;
}

void oracle_image_free(oracle_image *image)
{
    free(image->texels[0]);
    *image = (oracle_image){0};
}

// The part of [i, i + 1] within [low, high].
static double overlap(int i, double low, double high)
{
    return fmax(0.0, fmin(i + 1, high) - fmax(i, low));
}

// The mean over the area that texel (x, y) of a level covers in the level before.
static void average(const oracle_image *image, int level, const int at[2], bool coverage,
                    double mean[4])
{
    int w = oracle_image_side(image->width, level - 1);
    int h = oracle_image_side(image->height, level - 1);
    double across = (double)w / oracle_image_side(image->width, level);
    double down = (double)h / oracle_image_side(image->height, level);
    double low[2] = {at[0] * across, at[1] * down};
    double high[2] = {(at[0] + 1) * across, (at[1] + 1) * down};
    double area = 0.0, plain[4] = {0.0}, weighted[3] = {0.0};
    for (int y = (int)low[1]; y < h && y < high[1]; y++) {
        for (int x = (int)low[0]; x < w && x < high[0]; x++) {
            const double *texel = image->texels[level - 1][(size_t)y * (size_t)w + (size_t)x];
            double share = overlap(x, low[0], high[0]) * overlap(y, low[1], high[1]);
            area += share;
            for (int c = 0; c < 4; c++)
                plain[c] += share * texel[c];
            for (int c = 0; c < 3; c++)
                weighted[c] += share * texel[3] * texel[c];
        }
    }
    for (int c = 0; c < 4; c++)
        mean[c] = c < 3 && coverage && plain[3] > 0.0 ? weighted[c] / plain[3] : plain[c] / area;
}

void oracle_image_average(oracle_image *image, bool coverage)
{
    for (int level = 1; level < image->levels; level++) {
        int w = oracle_image_side(image->width, level);
        int h = oracle_image_side(image->height, level);
        for (int i = 0; i < w * h; i++)
            average(image, level, (int[]){i % w, i / w}, coverage, image->texels[level][i]);
    }
}

// The index of a texel in a row or column, from any whole number.
static int wrapped(double i, int size, oracle_wrap how)
{
    if (how == ORACLE_CLAMP)
        return (int)fmin(fmax(i, 0.0), size - 1.0);
    double period = how == ORACLE_MIRROR ? 2.0 * size : size;
    i -= period * floor(i / period);
    return (int)(i >= size ? period - 1.0 - i : i);
}

// Use of one level at (u, v): adds `share` times the mean of four texels, or of the nearest texel.
typedef struct use {
    int level;
    bool nearest;
    double share;
} use;

static void look_up_level(const oracle_texture *t, const use *of, const double uv[2],
                          double rgba[4])
{
    int size[2] = {oracle_image_side(t->image->width, of->level),
                   oracle_image_side(t->image->height, of->level)};
    double first[2], beyond[2];
    for (int k = 0; k < 2; k++) {
        double x = uv[k] * size[k] - 0.5;
        first[k] = floor(x);
        beyond[k] = x - first[k];
        if (of->nearest)
            beyond[k] = beyond[k] >= 0.5 ? 1.0 : 0.0;
    }
    for (int corner = 0; corner < 4; corner++) {
        double share = of->share;
        int at[2];
        for (int k = 0; k < 2; k++) {
            int step = corner >> k & 1;
            share *= step ? beyond[k] : 1.0 - beyond[k];
            at[k] = wrapped(first[k] + step, size[k], t->wrap[k]);
        }
        const double *texel =
            t->image->texels[of->level][(size_t)at[1] * (size_t)size[0] + (size_t)at[0]];
        for (int c = 0; c < 4; c++)
            rgba[c] += share * texel[c];
    }
}

// The distance aside from the transformed u and v to the border of a level's texel.
static double nearest_border(const oracle_texture *t, int level, const double uv[2],
                             const double speed[2])
{
    double least = INFINITY;
    for (int k = 0; k < 2; k++) {
        int size = oracle_image_side(k == 0 ? t->image->width : t->image->height, level);
        double x = uv[k] * size;
        if (speed[k] > 0.0)
            least = fmin(least, fabs(x - round(x)) / (speed[k] * size));
    }
    return least;
}

// The levels to look up, by the number of finest texels that a tap covers.
typedef struct choice {
    use fine, coarse;
    double turn;
} choice;

static choice choose(const oracle_texture *t, double texels)
{
    bool magnified = !(texels > 1.0);
    bool nearest = magnified ? t->magnified_nearest : t->minified_nearest;
    int last = t->mips == ORACLE_MIPS_NONE ? 0 : t->image->levels - 1;
    choice c = {.turn = INFINITY};
    if (t->magnified_nearest != t->minified_nearest)
        c.turn = fabs(texels - 1.0);
    double within = fmin(fmax(texels, 1.0), ldexp(1.0, last));
    int level = (int)floor(log2(within));
    double blend = within / ldexp(1.0, level) - 1.0;
    if (t->mips == ORACLE_MIPS_NEAREST) {
        if (level < last)
            c.turn = fmin(c.turn, fabs((1.0 + blend) / 1.5 - 1.0));
        level += blend >= 0.5;
        blend = 0.0;
    }
    c.fine = (use){level, nearest, 1.0 - blend};
    c.coarse = (use){blend > 0.0 ? level + 1 : level, nearest, blend};
    return c;
}

// The pixel's ellipse in texels: its longer axis, and the taps along it.
typedef struct ellipse {
    double width;    // width of a tap
    double length;   // length of the row of taps, in taps: at least 1
    double along[2]; // from tap to tap, in texture coordinates
} ellipse;

// `axes` are conjugate semi-axes: a linear map takes a circle's axes to them.
static ellipse ellipse_of(const oracle_texture *t, double axes[2][2], int most)
{
    double uu = 0.0, uv = 0.0, vv = 0.0; // entries of the ellipse's matrix
    for (int axis = 0; axis < 2; axis++) {
        uu += axes[axis][0] * axes[axis][0];
        uv += axes[axis][0] * axes[axis][1];
        vv += axes[axis][1] * axes[axis][1];
    }
    double angle = 0.5 * atan2(2.0 * uv, uu - vv);
    double longer = sqrt(0.5 * (uu + vv) + hypot(0.5 * (uu - vv), uv));
    double area = fabs(axes[0][0] * axes[1][1] - axes[0][1] * axes[1][0]);
    bool blends = t->mips == ORACLE_MIPS_LINEAR && !t->minified_nearest;
    double limit = blends && most > 1 ? most : 1.0;
    ellipse e = {longer, 1.0, {0.0, 0.0}};
    if (!(longer > 0.0))
        return e;
    e.width = fmin(longer, fmax(2.0 * area / longer, longer / limit));
    e.length = fmax(1.0, longer / fmax(e.width, 1.0));
    e.along[0] = longer / e.length * cos(angle) / t->image->width;
    e.along[1] = longer / e.length * sin(angle) / t->image->height;
    return e;
}

// The state of a look-up.
typedef struct look {
    const oracle_texture *texture;
    choice choice;
    double speed[2]; // change of u and of v per distance aside
    oracle_glance found;
} look;

// Adds `share` of a tap to the result.
static void add_tap(look *l, const double uv[2], double share)
{
    use fine = l->choice.fine, coarse = l->choice.coarse;
    fine.share *= share;
    coarse.share *= share;
    look_up_level(l->texture, &fine, uv, l->found.rgba);
    look_up_level(l->texture, &coarse, uv, l->found.rgba);
    if (fine.nearest) {
        double first = nearest_border(l->texture, fine.level, uv, l->speed);
        double second = nearest_border(l->texture, coarse.level, uv, l->speed);
        l->found.jump = fmin(l->found.jump, fmin(first, second));
    }
}

// Adds the mean along the ellipse. Up to a length of 2 there are two taps, length − 1 apart. Then
// there are 4 taps, 1 apart, and the outer two count in part; and so on.
static void add_taps(look *l, const ellipse *e, const double uv[2])
{
    if (e->length == 1.0) {
        add_tap(l, uv, 1.0);
        return;
    }
    double apart = fmin(e->length - 1.0, 1.0);
    for (int pair = 0; pair < 0.5 * e->length; pair++) {
        double share = fmin(0.5 * e->length - pair, 1.0) / e->length;
        for (int side = -1; side <= 1; side += 2) {
            double offset = side * (pair + 0.5) * apart;
            add_tap(l, (double[]){uv[0] + offset * e->along[0], uv[1] + offset * e->along[1]},
                    share);
        }
    }
}

oracle_glance oracle_look_up(const oracle_texture *t, const oracle_spot *spot)
{
    look l = {.texture = t, .found = {.jump = INFINITY}};
    double uv[2], axes[2][2]; // [axis][u, v], in texels
    int size[2] = {t->image->width, t->image->height};
    for (int k = 0; k < 2; k++) {
        const double *row = t->transform[k];
        uv[k] = row[0] * spot->at[0] + row[1] * spot->at[1] + row[2];
        double part[2];
        for (int axis = 0; axis < 2; axis++) {
            part[axis] = row[0] * spot->moved[axis][0] + row[1] * spot->moved[axis][1];
            axes[axis][k] = spot->width * part[axis] * size[k];
        }
        l.speed[k] = hypot(part[0], part[1]);
    }
    ellipse e = ellipse_of(t, axes, spot->taps);
    l.choice = choose(t, e.width);
    l.found.turn = l.choice.turn;
    add_taps(&l, &e, uv);
    for (int k = 0; k < 2 && !l.choice.fine.nearest; k++)
        l.found.slope += l.speed[k] * oracle_image_side(size[k], l.choice.fine.level);
    return l.found;
}
