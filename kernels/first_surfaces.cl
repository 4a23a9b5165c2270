// Fills the layers of the first surface: distance, normal and colour. It finds the surface a second
// time, apart from the frame's own work, with the same functions. So the layers show the data that
// the optics use, for every way of rendering samples.
#if GLINT_DIAGNOSTICS

static inline void note_first_surface(glint_layers_record *record, real3 normal, real3 color,
                                      int lane)
{
    record->normal[0] = (float)LANE(normal.x, lane);
    record->normal[1] = (float)LANE(normal.y, lane);
    record->normal[2] = (float)LANE(normal.z, lane);
    record->albedo[0] = (float)LANE(color.x, lane);
    record->albedo[1] = (float)LANE(color.y, lane);
    record->albedo[2] = (float)LANE(color.z, lane);
}

// Records the hits of a group's primary rays.
static inline void note_group(layers *l, const scene_buffers *scene,
                              const glint_frame_record *frame, const image_space *image,
                              primary first, int group)
{
    const mask met = first.places >= (lane_int)0;
    if (!any_lane(met)) {
        return;
    }
    const triangle triangles = load_triangles(scene, first.places, met);
    const path ray = primary_rays(frame, &first);
    closest hit = no_hit();
    measure_hits(image, &triangles, first.x, first.y, first.length, met, &hit);
    const surface s = find_surface(scene, &ray, &hit, &triangles);
    // Depth along the axis of view: a direction before normalisation advances the depth by 1.
    const real depth = hit.t / first.length + JOIN(frame->start[0], frame->start[1]);
    const real metres = depth * (scalar)frame->unit;
    for (uint left = mask_bits(met); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left);
        glint_layers_record *record = &l->of_pixel[group * GLINT_WIDTH + lane];
        record->triangle = scene->numbers[LANE_INT(first.places, lane)];
        record->z = (float)LANE(metres, lane);
        note_first_surface(record, s.normal, s.base_color, lane);
    }
}

// Records the hits of the primary rays of the middle samples.
static inline void note_first_surfaces(layers *l, const scene_buffers *scene,
                                       const glint_frame_record *frame, const image_space *image,
                                       const tile *t)
{
    for (int g = 0; g < TILE_GROUPS && l->is_middle && GLINT_GEOMETRY; g++) {
        note_group(l, scene, frame, image, primary_of(t, g), g);
    }
}

#endif
