// Where single precision cannot tell which side of an edge a path sees: what hangs on that is added
// up for each pixel, so that the pixels that it matters to can be rendered again in double.
//
// Every ray carries how far it may be off, as a cone (cones.cl): to first order, from the rounding
// of its start and its direction and of what came before, which surfaces magnify as they do what a
// pixel sees. A path is in doubt where it meets a triangle as near to an edge, or passes one by as
// near to it: it may have met what lies on the other side. So it is where it is off by more than
// LOST, or its direction by more than TURN_MOST. What is in doubt is counted once, with all that
// follows: its drift is NaN from there on, which no comparison finds in doubt.
#if GLINT_DOUBTS

// What rounding takes from the place of a hit, and from a direction, beside what the start is moved
// by (place_on_triangle).
#define PLACE_NOISE (R(2.0) * EPSILON)
#define TURN_NOISE (R(1.0) * EPSILON)
// A direction that is off by more shows something else.
#define LOST R(0x1p-11)
#define TURN_MOST R(0x1p-11)

static inline real grown(real width, real by) { return copysign(fabs(width) + by, width); }

// How far hits are off across their rays.
static inline real drift_of_hits(const drift *d, real t)
{
    return grown(fused(d->spread, t, d->width), real_of(PLACE_NOISE));
}

// How far beside a triangle a ray may be inside it, times 3: in the sheared space of intersect.cl both
// that way and the triangle's edge may be √3 times as long. 0 for what is no more in doubt.
static inline real margin_of_rays(const drift *d)
{
    const real most = real_of(DRIFT_MOST), zero = real_of(0);
    const real width = drift_of_hits(d, real_of(R(2.0)));
    const real size = SMALLER(fabs(width), most);
    return SELECT(width == width, size * R(3.0), zero);
}

// Those that are as near to an edge as they may be off, on one side of it or the other, or off by too
// much to tell.
static inline mask are_in_doubt(const triangle *t, const closest *hit, const path *ray, real width)
{
    const real least = SMALLEST3(R(1.0) - hit->b1 - hit->b2, hit->b1, hit->b2);
    const real reach = least * fabs(dot3(normal_of(t->vertices), ray->direction));
    width = fabs(width);
    return (reach <= width * t->longest) | (hit->beside < hit->t) | (width > LOST);
}

// How a surface changes the drift of rays, to first order and in the plane of incidence, where that
// is more: light that meets it a little beside meets it at w/cos θ, where the normal has turned.
typedef struct drifting {
    real width;  // across the ray that arrives
    real spread; // of it
    real turn;   // of the normal
    real inverse_cosine;
} drifting;

static inline drifting drift_at_surface(const path *ray, const triangle *t, const surface *s,
                                        real width)
{
    drifting d;
    d.width = width;
    d.spread = ray->drift.spread;
    d.inverse_cosine = R(1.0) / LARGER(s->cosine, real_of(R(0.015625)));
    const real curvature = SELECT(s->outside, t->curvature, -t->curvature);
    d.turn = curvature * width * d.inverse_cosine;
    return d;
}

static inline drift drift_of_branch(real width, real spread, const surface *s)
{
    drift d;
#if HAS_PLACES
    d.width = grown(width, s->offset);
#else
    d.width = width;
#endif
    d.spread = grown(spread, real_of(TURN_NOISE));
    return d;
}

static inline drift drift_of_reflected(const drifting *d, const surface *s)
{
    return drift_of_branch(d->width, fused(real_of(2), d->turn, d->spread), s);
}

#if GLINT_GLASS
// Of light that goes through a surface: cos θt = η cos θi − bend, dθt = η cos θi/cos θt dθi.
static inline drift drift_of_transmitted(const drifting *d, const surface *s, real eta, real bend)
{
    const real scaled = eta * s->cosine;
    const real beyond = LARGER(scaled - bend, real_of(TURN_NOISE));
    const real inverse = R(1.0) / beyond;
    return drift_of_branch(d->width * beyond * d->inverse_cosine,
                           fused(bend, d->turn, scaled * d->spread) * inverse, s);
}
#endif

#endif
