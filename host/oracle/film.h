// Computes rule 15, thin films. Internal to the oracle.
#ifndef GLINT_ORACLE_FILM_H
#define GLINT_ORACLE_FILM_H

#include "oracle/vector.h"

// Three media and the film's thickness. The base has an index of refraction for each of R, G and B.
typedef struct film_stack {
    double above, film, base[3];
    double thickness; // nm
} film_stack;

// The share of R, G and B that is reflected, for light from above at this cosine. There must be no
// total reflection on the way into the film.
vector oracle_film(const film_stack *stack, double cosine);

// The index, relative to empty space, of a surface that reflects f0 at right angles.
double oracle_index_of(double f0);

#endif
