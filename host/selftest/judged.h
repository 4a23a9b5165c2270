// A frame beside the oracle: what most cases of materials and of places are made of.
#ifndef GLINT_SELFTEST_JUDGED_H
#define GLINT_SELFTEST_JUDGED_H

#include "selftest/judge.h"
#include "selftest/trial.h"

#define JUDGED_EDGE 128 // look-ups err by 2/edge² at most

typedef struct judged {
    const glint_proxy *proxy; // of the environment; NULL: none. Set by the user, as zeros or this
    trial_picture picture;
    judge judge;
    oracle_view view; // of the same depth; its user may ask for more
} judged;

// Renders a scene in the light E(d) = ½ + ½d, of JUDGED_EDGE² texels a face, and gives it to the
// oracle, which is to heed the same settings. judged_end is due whatever the outcome.
glint_status judged_frame(trial *t, const glint_scene *scene, const glint_camera *camera,
                          const glint_settings *settings, judged *out);

// What the oracle sees in pixel `p`, counted from the top left, row by row.
void judged_pixel(const judged *of, int p, double expected[4], oracle_report *report);

// The root mean square of all pixels' differences in R, G and B, over the mean.
double judged_rmse(const judged *of);

void judged_end(judged *of); // a zeroed one is allowed

#endif
