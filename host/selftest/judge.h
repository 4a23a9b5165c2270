// The oracle as the self-test asks it.
#ifndef GLINT_SELFTEST_JUDGE_H
#define GLINT_SELFTEST_JUDGE_H

#include "oracle/oracle.h"
#include "render/plan.h"
#include "render/probe.h"
#include "scene/scene.h"

// The scene's triangles in metres, all white mirrors, for closest hits alone. Borrows nothing.
glint_status judge_begin(const glint_scene *scene, oracle_scene *judge, glint_error *error);
void judge_end(oracle_scene *judge); // a zeroed one is allowed

// The closest hit of a ray in metres.
oracle_hit judge_ray(const oracle_scene *judge, const glint_probe_ray *ray);

// The triangle that the middle of a pixel shows; −1: none.
int judge_pixel(const oracle_scene *judge, const oracle_view *view, int column, int row);

oracle_view judge_view(const glint_camera *camera, const glint_settings *settings);

#endif
