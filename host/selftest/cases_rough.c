// Tests hard cases of surfaces that send light in many directions: lobes of metal and paint, facets
// of glass, clear coats, dispersion, thin films. The oracle judges, by plain quadrature.
#include "base/memory.h"
#include "selftest/judged.h"
#include "selftest/shapes.h"
#include "selftest/trial.h"

#include <math.h>

typedef struct rough_ball {
    const char *what;
    shape_material material;
    float roughness;
    int depth, strata; // the oracle's directions along each axis
    double bound;
    bool half_specular;
    float clearcoat, clearcoat_roughness, dispersion, film, anisotropy, sheen, sheen_roughness,
        through;
} rough_ball;

// Sets a ball's tangents, which run around it.
static glint_status brush_ball(glint_scene *scene, glint_error *error)
{
    scene->attribute_set = (glint_attributes){.texcoords = true, .tangents = true};
    const size_t stride = glint_attributes_stride(&scene->attribute_set);
    float *values = glint_allocate(3 * scene->triangle_count * stride, sizeof *values);
    if (values == NULL) {
        return glint_fail_memory(error, "a self-test");
    }
    scene->attributes = values;
    for (size_t i = 0; i < 3 * scene->triangle_count; i++) {
        const float *p = scene->positions + 3 * i;
        const double length = hypot((double)p[0], (double)p[2]);
        float *tangent = values + stride * i + 2;
        tangent[0] = length > 0 ? (float)((double)p[2] / length) : 1;
        tangent[2] = length > 0 ? (float)(-(double)p[0] / length) : 0;
        tangent[3] = 1;
    }
    return GLINT_OK;
}

static glint_status make_ball(const rough_ball *of, glint_scene *scene, glint_error *error)
{
    static const double centre[3] = {0, 0, 0};
    shape s = shape_begin();
    shape_add_ball(&s, &(shape_ball){centre, 0.8, 3, of->material, true, NULL});
    TRY(shape_end(&s, scene, error));
    glint_material *m = &scene->materials[of->material];
    m->roughness = of->roughness;
    m->specular = of->half_specular ? 0.5F : 1;
    m->clearcoat = of->clearcoat;
    m->clearcoat_roughness = of->clearcoat_roughness;
    m->dispersion = of->dispersion;
    m->anisotropy = of->anisotropy;
    m->anisotropy_rotation = 0.6F;
    m->sheen_color[0] = of->sheen;
    m->sheen_color[2] = 0.5F * of->sheen;
    m->sheen_roughness = of->sheen_roughness;
    m->diffuse_transmission = of->through;
    m->diffuse_transmission_color[1] = 0.5F;
    m->iridescence = of->film;
    m->iridescence_ior = 1.6F;
    m->iridescence_thickness[1] = 400;
    return of->anisotropy > 0 ? brush_ball(scene, error) : GLINT_OK;
}

// Measures the relative RMSE of the pixels that show the ball.
static void measure_ball(trial *t, const judged *frame, const rough_ball *ball)
{
    const trial_picture *picture = &frame->picture;
    glint_measure *m = trial_error(t, ball->what, "of the mean", ball->bound);
    double squares = 0, light = 0;
    int count = 0;
    for (int p = 0; p < picture->width * picture->height; p++) {
        double expected[4];
        oracle_report report;
        judged_pixel(frame, p, expected, &report);
        for (int k = 0; k < 3 && report.surfaces > 0; k++, count++) {
            const double off = picture->values[4 * p + k] - expected[k];
            squares += off * off;
            light += expected[k];
        }
    }
    measure_error(m, sqrt(squares * count) / light, "relative RMSE over %d values", count);
}

static glint_status render_ball(trial *t, const rough_ball *ball)
{
    static const double eye[3] = {0.3, 0.4, 2.6}, target[3] = {0, 0, 0};
    glint_scene scene = {0};
    judged frame = {0};
    const glint_settings settings = trial_lobe_settings(t, ball->depth);
    const glint_camera camera = shape_camera(eye, target, 0.75, 0);
    glint_status status;
    TRY_OR(cleanup, status, make_ball(ball, &scene, t->error));
    TRY_OR(cleanup, status, judged_frame(t, &scene, &camera, &settings, &frame));
    frame.view.roughness = ball->strata;
    measure_ball(t, &frame, ball);
cleanup:
    judged_end(&frame);
    glint_scene_free(&scene);
    return status;
}

// Bounds: exact lobes err by a few thousandths. 1024 facets err by a thousandth at one surface and
// by about a hundredth at two, as do the oracle's. The environment's texels err by a
// ten-thousandth.
static const rough_ball balls[] = {
    {.what = "metal, roughness 0.6",
     .material = MATERIAL_TINTED,
     .roughness = 0.6F,
     .depth = 1,
     .strata = 96,
     .bound = 0.003},
    {.what = "glass, roughness 0.4: one surface",
     .material = MATERIAL_GLASS,
     .roughness = 0.4F,
     .depth = 1,
     .strata = 24,
     .bound = 0.0015},
    {.what = "brushed metal, roughness 0.4",
     .material = MATERIAL_TINTED,
     .roughness = 0.4F,
     .depth = 1,
     .strata = 96,
     .bound = 0.004,
     .anisotropy = 0.7F},
    {.what = "metal below sheen of roughness 0.2",
     .material = MATERIAL_TINTED,
     .roughness = 0,
     .depth = 1,
     .strata = 96,
     .bound = 0.001,
     .sheen = 0.8F,
     .sheen_roughness = 0.2F},
};

static const rough_ball more_balls[] = {
    {.what = "paint, roughness 0.4, half of its coat",
     .material = MATERIAL_PAINT,
     .roughness = 0.4F,
     .depth = 1,
     .strata = 64,
     .bound = 0.001,
     .half_specular = true},
    {.what = "metal, roughness 0.15",
     .material = MATERIAL_TINTED,
     .roughness = 0.15F,
     .depth = 1,
     .strata = 96,
     .bound = 0.003},
    {.what = "glass, roughness 0.4, half of what it reflects",
     .material = MATERIAL_GLASS,
     .roughness = 0.4F,
     .depth = 2,
     .strata = 24,
     .bound = 0.012,
     .half_specular = true},
    {.what = "metal, roughness 0.4, a smooth coat",
     .material = MATERIAL_TINTED,
     .roughness = 0.4F,
     .depth = 1,
     .strata = 64,
     .bound = 0.003,
     .clearcoat = 0.7F},
    {.what = "glass, a coat of roughness 0.3",
     .material = MATERIAL_GLASS,
     .roughness = 0,
     .depth = 2,
     .strata = 64,
     .bound = 0.003,
     .clearcoat = 1,
     .clearcoat_roughness = 0.3F},
    {.what = "glass of dispersion 1",
     .material = MATERIAL_GLASS,
     .roughness = 0,
     .depth = 2,
     .strata = 0,
     .bound = 3e-4,
     .dispersion = 1},
    {.what = "glass of dispersion 1, roughness 0.4",
     .material = MATERIAL_GLASS,
     .roughness = 0.4F,
     .depth = 1,
     .strata = 24,
     .bound = 0.0015,
     .dispersion = 1},
    {.what = "metal below a film",
     .material = MATERIAL_TINTED,
     .roughness = 0,
     .depth = 1,
     .strata = 0,
     .bound = 3e-4,
     .film = 1},
    {.what = "glass below a film",
     .material = MATERIAL_GLASS,
     .roughness = 0,
     .depth = 2,
     .strata = 0,
     .bound = 3e-4,
     .film = 1},
    {.what = "paint of roughness 0.4 below a film",
     .material = MATERIAL_PAINT,
     .roughness = 0.4F,
     .depth = 1,
     .strata = 64,
     .bound = 0.004,
     .film = 1},
    {.what = "paint below sheen of roughness 0.5",
     .material = MATERIAL_PAINT,
     .roughness = 1,
     .depth = 1,
     .strata = 64,
     .bound = 5e-4,
     .sheen = 1,
     .sheen_roughness = 0.5F},
    {.what = "paint that is lit from behind",
     .material = MATERIAL_PAINT,
     .roughness = 0,
     .depth = 1,
     .strata = 0,
     .bound = 3e-4,
     .through = 0.7F},
};

static glint_status rough_balls(trial *t)
{
    for (size_t i = 0; i < sizeof balls / sizeof *balls; i++) {
        TRY(render_ball(t, &balls[i]));
    }
    return GLINT_OK;
}

static glint_status more_rough_balls(trial *t)
{
    for (size_t i = 0; i < sizeof more_balls / sizeof *more_balls; i++) {
        TRY(render_ball(t, &more_balls[i]));
    }
    return GLINT_OK;
}

const trial_case rough_cases[] = {
    {"rough_balls", "metal, paint and glass of several roughnesses: the oracle's colours",
     rough_balls},
    {"more_rough_balls", "the same with coats, films, sheen and dispersion", more_rough_balls},
    {0},
};
