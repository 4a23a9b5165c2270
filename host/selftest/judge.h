// Gives scenes to the oracle and asks it for the self-test.
#ifndef GLINT_SELFTEST_JUDGE_H
#define GLINT_SELFTEST_JUDGE_H

#include "oracle/oracle.h"
#include "render/plan.h"
#include "render/probe.h"
#include "scene/scene.h"

// A scene in the oracle's form, in metres. Its data is copied; no code of the judged renderer is
// called. Textures are the levels that the device gets. Zero is valid: nothing.
typedef struct judge {
    // The user sets its environment.
    oracle_scene scene;
    oracle_triangle *triangles;
    oracle_corner (*corners)[3];
    oracle_material *materials;
    size_t image_count;
    oracle_image *images;
    oracle_punctual *lights;
    oracle_tree *tree;
} judge;

glint_status judge_begin(const glint_scene *scene, judge *j, glint_error *error);
void judge_end(judge *j); // a zeroed judge is allowed

// Moves the corners to `exact`, [triangle][3][3] in stored coordinates.
glint_status judge_move(judge *j, const glint_scene *scene, const double *exact,
                        glint_error *error);

// Sets the environment of trial_linear_environment: E(d) = ½ + ½d.
void judge_use_linear_light(judge *j);

// The closest hit of a ray in metres.
oracle_hit judge_ray(const oracle_scene *scene, const glint_probe_ray *ray);

// The triangle in the middle of a pixel; −1: none.
int judge_pixel(const oracle_scene *scene, const oracle_view *view, int column, int row);

oracle_view judge_view(const glint_camera *camera, const glint_settings *settings);

#endif
