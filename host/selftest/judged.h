// Compares a frame with the oracle, for cases of materials and of places.
#ifndef GLINT_SELFTEST_JUDGED_H
#define GLINT_SELFTEST_JUDGED_H

#include "selftest/judge.h"
#include "selftest/trial.h"

#define JUDGED_EDGE 128 // look-ups err by 2/edge² at most

typedef struct judged {
    // The environment's proxy; NULL: none. The user sets it before the call.
    const glint_proxy *proxy;
    trial_picture picture;
    judge judge;
    oracle_proxy seen_proxy; // the proxy as the oracle takes it
    // Has the frame's depth. The user may change it.
    oracle_view view;
} judged;

// Renders a scene under E(d) = ½ + ½d, with JUDGED_EDGE² texels a face, and gives it to the oracle
// with the same settings. Call judged_end, whatever the outcome.
glint_status judged_frame(trial *t, const glint_scene *scene, const glint_camera *camera,
                          const glint_settings *settings, judged *out);

// The oracle's colour of pixel `p`, counted from the top left, row by row.
void judged_pixel(const judged *of, int p, double expected[4], oracle_report *report);

// How far a pixel moves from `expected`, at most, if rays start beside surfaces by this share of
// their coordinates, on either side (oracle_view.start). Ill-conditioned pixels move far.
double judged_spread(const judged *of, int p, double start, const double expected[4]);

// Compares all values of the pixels in which no decision is close: an edge, the critical angle, the
// least weight, a texture's jump.
void judged_compare(const judged *of, glint_measure *errors);

// The same as a share of values that are off by more than `bound`.
void judged_count(const judged *of, double bound, glint_measure *share);

// Compares the sum of each pixel's terms, which layers hold, with the picture. Leaves out
// pixels whose terms did not all fit.
void judged_compare_terms(const judged *of, glint_measure *errors);

// Compares the triangles and barycentric weights that a frame of hits holds with the oracle's.
// Leaves out pixels near edges.
void judged_compare_hits(const judged *of, glint_measure *errors);

// The root mean square of all differences in R, G and B, over the mean.
double judged_rmse(const judged *of);

void judged_end(judged *of); // a zeroed one is allowed

#endif
