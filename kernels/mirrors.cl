// Renders frames in which every sample takes one look-up: mirrors that see only the environment,
// and the environment alone. A look-up's direction may have any length, and r = 2n(n·v) − v does
// not depend on the sign of the normal. So this code normalises and orients no vectors. The normals
// are sums of the vertices' normals, whose weights need not add up to 1.
#define ONE_LOOKUP GLINT_TAKES_ONE_LOOKUP(IS_COMPILED)
#if ONE_LOOKUP

// The points where the samples of a tile's pixels see the environment.
typedef struct sights {
    cube_point points[TILE_GROUPS];
#if GLINT_TINT // TINT implies GEOMETRY
    scalar weights[TILE_GROUPS * PIXEL_VALUES];
#endif
} sights;

// The normals along which the surfaces reflect: interpolated normals or the triangles' own.
static inline real3 mirror_normals(const image_space *image, const triangle *t, real3 geometric,
                                   const primary *first, mask met)
{
#if GLINT_SMOOTH_NORMALS
    const image_corners corners = corners_in_image(image, t);
    real weights[3];
    image_weights(&corners, first->x, first->y, met, weights);
    const real3 *n = t->normals;
    mask valid;
    real3 smooth = moderate(
        scale_add(n[2], weights[2], scale_add(n[1], weights[1], scale(n[0], weights[0]))), &valid);
    const mask given = normals_given(n) & valid;
    if (!any_lane(met & !given)) {
        return smooth;
    }
    return select3(given, smooth, moderate(geometric, &valid));
#else
    mask valid;
    return moderate(geometric, &valid);
#endif
}

// The directions in which mirrors show the environment to rays along d. `cosine` is the cosine of
// the angle between the normal and the viewer.
static inline real3 mirrored(const image_space *image, const triangle *t, const primary *first,
                             real3 d, mask met, real *cosine)
{
    real3 geometric = normal_of(t->vertices);
    // A sliver whose edges are parallel in this precision has no normal; it faces the viewer.
    geometric = select3(is_zero3(geometric), d, geometric);
    const real3 n = mirror_normals(image, t, geometric, first, met);
    const real squared = dot3(n, n), along = dot3(n, d);
    real3 r = scale_add(n, R(-2.0) * along, scale(d, squared));
    // Fold directions on the other side than the viewer's back (fold_to_side).
    const real viewer_side = -dot3(d, geometric), side = dot3(r, geometric);
    mask beyond = met & ((side > R(0.0)) != (viewer_side > R(0.0)));
    if (any_lane(beyond)) {
        mask valid;
        const real3 g = moderate(geometric, &valid);
        r = select3(beyond, scale_add(g, R(-2.0) * dot3(r, g) / dot3(g, g), r), r);
    }
    *cosine = fabs(along) * inverse_root(squared) * inverse_root(dot3(d, d));
    return r;
}

// The mirrors' weights. Counts the reflected rays, and the light that the depth cuts off.
static inline real3 mirror_weights(const scene_buffers *scene, const glint_frame_record *frame,
                                   const triangle *t, real cosine, mask met, const pixels *pixels,
                                   tally *tally)
{
    const real one = real_of(1);
    real3 weights = real3_of(one, one, one);
    if (GLINT_TINT) {
        surface s;
        load_materials(scene, t, &s);
        const real3 tint = metal_reflectance(s.base_color, SMALLER(cosine, one), HAS(FRESNEL));
        weights = select3(met, tint, weights);
    }
    mask reflects = met & (largest3(weights) > R(0.0));
    ended(frame, largest3(weights), int_of(1), reflects, pixels, tally);
    tally->counts[GLINT_COUNT_REFLECTED] += (ulong)count_lanes(reflects);
    return weights;
}

// Finds the points where the samples of a group see the environment.
static inline void find_sights(const scene_buffers *scene, const glint_frame_record *frame,
                               const image_space *image, const primary *first, int group,
                               sights *all, tally *tally)
{
    real3 d = primary_directions(frame, first->x, first->y);
    real3 weights = real3_of(real_of(1), real_of(1), real_of(1));
    const pixels pixels = pixels_of_group(group);
    mask met = first->places >= (lane_int)0; // pixels outside the image hit nothing: clear_tile
    const bool shows_mirrors = HAS(GEOMETRY) && any_lane(met);
    if (shows_mirrors) {
        const triangle t = load_triangles(scene, first->places, met);
        real cosine;
        d = select3(met, mirrored(image, &t, first, d, met, &cosine), d);
        weights = mirror_weights(scene, frame, &t, cosine, met, &pixels, tally);
        tally->deepest = SELECT(met, int_of(1), tally->deepest);
#if GLINT_DIAGNOSTICS
        note_surfaces(tally->layers, &pixels, met, int_of(1));
        note_truncation(tally->layers, &pixels, met, weights);
#endif
    }
    // Find the texels of the look-up.
#if GLINT_TINT
    to_pixels(weights.x, weights.y, weights.z, real_of(0), all->weights + group * PIXEL_VALUES);
#endif
    const cube_map *map = &scene->environment;
    cube_point *point = &all->points[group];
    *point = find_on_cube(turn_into_environment(frame, d), int_of(map->edge), int_of(0));
#if GLINT_DIAGNOSTICS
    note_faces(tally->layers, &pixels, mask_all(), weights, face_of(map, point));
#endif
    // Pixels that show only the environment share its texels with their neighbours.
    for (int lane = 0; lane < GLINT_WIDTH && shows_mirrors; lane++) {
        prefetch_texels(map, map->edge, (size_t)LANE_INT(point->first, lane));
    }
}

// The light from the environment for one row of a group's pixels.
static inline pixel_row look_up_row(const cube_map *map, const cube_point *point, int row)
{
    const int first = row * PACKET_WIDTH;
#define AT(i) fetch_at(point, map, map->edge, first + i)
#if GLINT_WIDTH == 1
    return AT(0);
#else
    return (pixel_row)(AT(0), AT(1), AT(2), AT(3));
#endif
#undef AT
}

// Adds a sample of each of the tile's pixels to their sums. The first sample sets the sums.
static inline void add_sights(const scene_buffers *scene, const sights *all, bool is_first,
                              scalar *sums)
{
    for (int g = 0; g < TILE_GROUPS; g++) {
        scalar *pixels = sums + g * PIXEL_VALUES;
#pragma unroll
        for (int j = 0; j < PACKET_HEIGHT; j++) {
            pixel_row light = look_up_row(&scene->environment, &all->points[g], j);
#if GLINT_TINT
            light *= load_pixel_row(j, all->weights + g * PIXEL_VALUES);
#endif
            store_pixel_row(is_first ? light : load_pixel_row(j, pixels) + light, j, pixels);
        }
    }
}
#endif
