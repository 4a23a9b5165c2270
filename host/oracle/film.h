// Between the oracle's own files: rule 15, thin films.
#ifndef GLINT_ORACLE_FILM_H
#define GLINT_ORACLE_FILM_H

#include "oracle/vector.h"

// Three media and the film's thickness: the base has an index of refraction for each of R, G and B.
typedef struct film_stack {
    double above, film, base[3];
    double thickness; // nm
} film_stack;

// What of R, G and B is reflected that arrives from above at this cosine. Nothing may be reflected
// totally on the way into the film.
vector oracle_film(const film_stack *stack, double cosine);

// The index over that of empty space at which a surface reflects f0 at right angles.
double oracle_index_of(double f0);

#endif
