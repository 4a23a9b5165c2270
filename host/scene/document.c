// Opens documents, and checks every reference in them. See document.h.
#include "scene/document.h"

#include "scene/gltf/curve.h"
#include "scene/lights.h"
#include "scene/scene.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>

// ---- The fields ---------------------------------------------------------------------------------

typedef enum kind {
    TEXT,
    RUN,      // of the table `of`, after the run of the row before
    INDEX,    // a row of the table `of`, or −1
    ROW,      // a row of the table `of`
    AFTER,    // 1 + a row of the table `of`, or 0
    ARRAY,    // an array of at least `of` components, or −1
    UNSIGNED, // the same, of unsigned integers
    RANGE,    // a whole number from `of` to `most`
    FLAG,     // a bool
    FLOATS,   // `of` floats from `low` to `high`
    DOUBLES,  // the same, doubles
} kind;

typedef struct field_row {
    const char *name; // for messages
    glint_document_table table;
    kind kind;
    size_t offset; // in a row
    int of, most;
    size_t repeats, step; // how often it stands in a row (0: once), and the bytes between
    double low, high;
} field_row;

#define FIELD_ROW(table_, type, member, kind_, ...)                                                \
    {                                                                                              \
        .name = #table_ "." #member, .table = GLINT_TABLE_##table_, .kind = (kind_),               \
        .offset = offsetof(type, member), __VA_ARGS__                                              \
    }
#define WHOLE_ROW(table_, kind_, ...)                                                              \
    {                                                                                              \
        .name = #table_, .table = GLINT_TABLE_##table_, .kind = (kind_), __VA_ARGS__               \
    }
#define FIELD(table, type, member, kind, of_) FIELD_ROW(table, type, member, kind, .of = (of_))
#define WITHIN(table, type, member, least, most_)                                                  \
    FIELD_ROW(table, type, member, RANGE, .of = (least), .most = (most_))
#define SEVERAL(table, type, member, kind, of_, count)                                             \
    FIELD_ROW(table, type, member, kind, .of = (of_), .repeats = (count),                          \
              .step = sizeof((type *)0)->member[0])
#define NUMBERS(table, type, member, kind, count, low_, high_)                                     \
    FIELD_ROW(table, type, member, kind, .of = (count), .low = (low_), .high = (high_))
#define FLOATS_OF_MATERIAL(kind, name, least, most, ...)                                           \
    NUMBERS(materials, glint_document_material, material.name, FLOATS,                             \
            sizeof((glint_material *)0)->name / sizeof(float), least, most),
#define OF_TEXTURES(member, kind, of_, most_)                                                      \
    FIELD_ROW(materials, glint_document_material, material.textures[0].member, kind, .of = (of_),  \
              .most = (most_), .repeats = GLINT_TEXTURE_SLOTS, .step = sizeof(glint_texture_use),  \
              .low = -FLT_MAX, .high = FLT_MAX)

static const field_row fields[] = {
    WHOLE_ROW(node_lists, ROW, .of = GLINT_TABLE_nodes),
    WHOLE_ROW(joints, ROW, .of = GLINT_TABLE_nodes),
    WHOLE_ROW(weights, DOUBLES, .of = 1, .low = -DBL_MAX, .high = DBL_MAX),
    FIELD(notes, glint_document_note, where, TEXT, 0),
    FIELD(notes, glint_document_note, text, TEXT, 0),
    WITHIN(arrays, glint_document_array, components, 1, 16),
    WITHIN(arrays, glint_document_array, is_normalized, 0, 1),
    FIELD(nodes, glint_document_node, name, TEXT, 0),
    FIELD(nodes, glint_document_node, parent, INDEX, GLINT_TABLE_nodes),
    FIELD(nodes, glint_document_node, children, RUN, GLINT_TABLE_node_lists),
    FIELD(nodes, glint_document_node, mesh, INDEX, GLINT_TABLE_meshes),
    FIELD(nodes, glint_document_node, camera, INDEX, GLINT_TABLE_cameras),
    FIELD(nodes, glint_document_node, skin, INDEX, GLINT_TABLE_skins),
    FIELD(nodes, glint_document_node, light, INDEX, GLINT_TABLE_lights),
    NUMBERS(nodes, glint_document_node, matrix, DOUBLES, 16, -DBL_MAX, DBL_MAX),
    NUMBERS(nodes, glint_document_node, translation, DOUBLES, 3, -DBL_MAX, DBL_MAX),
    NUMBERS(nodes, glint_document_node, rotation, DOUBLES, 4, -DBL_MAX, DBL_MAX),
    NUMBERS(nodes, glint_document_node, scale, DOUBLES, 3, -DBL_MAX, DBL_MAX),
    FIELD(nodes, glint_document_node, weights, RUN, GLINT_TABLE_weights),
    SEVERAL(nodes, glint_document_node, instances, ARRAY, 3, 3),
    FIELD(nodes, glint_document_node, instances[1], ARRAY, 4),
    FIELD(nodes, glint_document_node, notes, RUN, GLINT_TABLE_notes),
    FIELD(meshes, glint_document_mesh, primitives, RUN, GLINT_TABLE_primitives),
    FIELD(meshes, glint_document_mesh, weights, RUN, GLINT_TABLE_weights),
    WITHIN(primitives, glint_document_primitive, mode, 0, 6),
    FIELD(primitives, glint_document_primitive, material, INDEX, GLINT_TABLE_materials),
    FIELD(primitives, glint_document_primitive, positions, ARRAY, 3),
    FIELD(primitives, glint_document_primitive, normals, ARRAY, 3),
    FIELD(primitives, glint_document_primitive, indices, UNSIGNED, 1),
    FIELD(primitives, glint_document_primitive, tangents, ARRAY, 4),
    FIELD(primitives, glint_document_primitive, colors, ARRAY, 3),
    SEVERAL(primitives, glint_document_primitive, texcoords, ARRAY, 2, 2),
    FIELD(primitives, glint_document_primitive, targets, RUN, GLINT_TABLE_targets),
    FIELD(primitives, glint_document_primitive, influences, RUN, GLINT_TABLE_influences),
    FIELD(primitives, glint_document_primitive, mappings, RUN, GLINT_TABLE_mappings),
    FIELD(primitives, glint_document_primitive, mapping_fault, TEXT, 0),
    FIELD(primitives, glint_document_primitive, notes, RUN, GLINT_TABLE_notes),
    FIELD(targets, glint_document_target, positions, ARRAY, 3),
    FIELD(targets, glint_document_target, normals, ARRAY, 3),
    FIELD(influences, glint_document_influence, joints, UNSIGNED, 4),
    FIELD(influences, glint_document_influence, weights, ARRAY, 4),
    FIELD(mappings, glint_document_mapping, variant, ROW, GLINT_TABLE_variants),
    FIELD(mappings, glint_document_mapping, material, ROW, GLINT_TABLE_materials),
    FIELD(materials, glint_document_material, name, TEXT, 0),
    SEVERAL(materials, glint_document_material, texture_keys, TEXT, 0, GLINT_TEXTURE_SLOTS),
    FIELD(materials, glint_document_material, missing, RUN, GLINT_TABLE_missing),
    FIELD(materials, glint_document_material, notes, RUN, GLINT_TABLE_notes),
    GLINT_MATERIAL_TABLE(FLOATS_OF_MATERIAL)
        FIELD(materials, glint_document_material, material.unlit, FLAG, 0),
    FIELD(materials, glint_document_material, material.has_vertex_colors, FLAG, 0),
    WITHIN(materials, glint_document_material, material.alpha_mode, 0, GLINT_ALPHA_BLEND),
    OF_TEXTURES(image, AFTER, GLINT_TABLE_images, 0),
    OF_TEXTURES(texcoord, RANGE, 0, 1),
    OF_TEXTURES(wrap_s, RANGE, 0, GLINT_WRAP_MIRROR),
    OF_TEXTURES(wrap_t, RANGE, 0, GLINT_WRAP_MIRROR),
    OF_TEXTURES(mips, RANGE, 0, GLINT_MIP_NONE),
    OF_TEXTURES(magnified_nearest, FLAG, 0, 0),
    OF_TEXTURES(minified_nearest, FLAG, 0, 0),
    OF_TEXTURES(transform, FLOATS, 6, 0),
    WITHIN(missing, glint_document_missing, slot, 0, GLINT_TEXTURE_SLOTS - 1),
    FIELD(missing, glint_document_missing, key, TEXT, 0),
    FIELD(missing, glint_document_missing, where, TEXT, 0),
    FIELD(missing, glint_document_missing, text, TEXT, 0),
    FIELD(images, glint_document_image, shown, TEXT, 0),
    FIELD(images, glint_document_image, uri, TEXT, 0),
    FIELD(images, glint_document_image, fault, TEXT, 0),
    FIELD(cameras, glint_document_camera, name, TEXT, 0),
    NUMBERS(cameras, glint_document_camera, size, DOUBLES, 1, 0, DBL_MAX),
    FIELD(cameras, glint_document_camera, notes, RUN, GLINT_TABLE_notes),
    FIELD(lights, glint_document_light, name, TEXT, 0),
    WITHIN(lights, glint_document_light, kind, -1, GLINT_PUNCTUAL_DIRECTIONAL),
    NUMBERS(lights, glint_document_light, color, DOUBLES, 3, 0, DBL_MAX),
    NUMBERS(lights, glint_document_light, range, DOUBLES, 1, 0, DBL_MAX),
    NUMBERS(lights, glint_document_light, inner_angle, DOUBLES, 1, 0, DBL_MAX),
    NUMBERS(lights, glint_document_light, outer_angle, DOUBLES, 1, 0, DBL_MAX),
    FIELD(lights, glint_document_light, notes, RUN, GLINT_TABLE_notes),
    FIELD(skins, glint_document_skin, joints, RUN, GLINT_TABLE_joints),
    FIELD(skins, glint_document_skin, inverse_bind, ARRAY, 16),
    FIELD(animations, glint_document_animation, name, TEXT, 0),
    FIELD(animations, glint_document_animation, channels, RUN, GLINT_TABLE_channels),
    FIELD(animations, glint_document_animation, notes, RUN, GLINT_TABLE_notes),
    FIELD(channels, glint_document_channel, node, ROW, GLINT_TABLE_nodes),
    WITHIN(channels, glint_document_channel, property, 0, GLINT_PROPERTIES - 1),
    WITHIN(channels, glint_document_channel, interpolation, 0, GLINT_INTERPOLATION_CUBIC),
    FIELD(channels, glint_document_channel, input, ARRAY, 1),
    FIELD(channels, glint_document_channel, output, ARRAY, 1),
    FIELD(variants, glint_document_variant, name, TEXT, 0),
    FIELD(scenes, glint_document_scene, name, TEXT, 0),
    FIELD(scenes, glint_document_scene, roots, RUN, GLINT_TABLE_node_lists),
    FIELD(scenes, glint_document_scene, notes, RUN, GLINT_TABLE_notes),
    FIELD(usages, glint_document_usage, name, TEXT, 0),
    WITHIN(usages, glint_document_usage, treatment, 0, GLINT_IGNORED),
};

static const size_t row_bytes[] = {
#define TABLE(name, type) sizeof(type),
    GLINT_DOCUMENT_TABLES(TABLE)
#undef TABLE
};

typedef struct check_state {
    const glint_document *document;
    const glint_document_place *places; // [GLINT_TABLES]
    uint64_t end;                       // of the run before, for runs of one field
} check_state;

static bool array_fits(const check_state *checker, int32_t index, int components, bool is_unsigned)
{
    if (index == -1) {
        return true;
    }
    if (index < 0 || (size_t)index >= checker->document->arrays_count) {
        return false;
    }
    const glint_document_array *array = &checker->document->arrays[index];
    const bool holds_unsigned = !array->is_normalized && (array->type == GLINT_COMPONENT_UINT8 ||
                                                          array->type == GLINT_COMPONENT_UINT16 ||
                                                          array->type == GLINT_COMPONENT_UINT32);
    return array->components >= components && (holds_unsigned || !is_unsigned);
}

static bool run_follows(check_state *checker, glint_run run, int table)
{
    const uint64_t end = (uint64_t)run.first + run.count;
    const bool fits =
        run.count == 0 || (end <= checker->places[table].count && run.first >= checker->end);
    checker->end = run.count == 0 ? checker->end : end;
    return fits;
}

// False also for NaN.
static bool numbers_are_within(const field_row *field, const unsigned char *at)
{
    for (int i = 0; i < field->of; i++) {
        float single;
        double value;
        if (field->kind == FLOATS) {
            memcpy(&single, at + (size_t)i * sizeof single, sizeof single);
            value = (double)single;
        } else {
            memcpy(&value, at + (size_t)i * sizeof value, sizeof value);
        }
        if (!(value >= field->low && value <= field->high)) {
            return false;
        }
    }
    return true;
}

static bool is_good(check_state *checker, const field_row *field, const unsigned char *at)
{
    int32_t number = 0;
    glint_run run;
    if (field->kind != FLAG) { // its row may end behind it
        memcpy(&number, at, sizeof number);
    }
    switch (field->kind) {
    case TEXT:
        return (uint32_t)number < checker->document->texts_count;
    case RUN:
        memcpy(&run, at, sizeof run);
        return run_follows(checker, run, field->of);
    case INDEX:
        return number >= -1 && (int64_t)number < (int64_t)checker->places[field->of].count;
    case ROW:
        return number >= 0 && (uint64_t)number < checker->places[field->of].count;
    case AFTER:
        return (uint32_t)number <= checker->places[field->of].count;
    case ARRAY:
    case UNSIGNED:
        return array_fits(checker, number, field->of, field->kind == UNSIGNED);
    case RANGE:
        return number >= field->of && number <= field->most;
    case FLAG:
        return *at <= 1;
    default:
        return numbers_are_within(field, at);
    }
}

static glint_status refuse(const char *what, size_t row, glint_error *error)
{
    return glint_fail(
        error, GLINT_BAD_INPUT,
        "glint-decoder gave a damaged document: %s of row %zu (please report the file)", what, row);
}

static glint_status check_fields(check_state *checker, glint_error *error)
{
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        const field_row *field = &fields[f];
        const glint_document_place *place = &checker->places[field->table];
        checker->end = 0;
        for (size_t row = 0; row < place->count; row++) {
            const unsigned char *at = checker->document->block + place->offset +
                                      row * row_bytes[field->table] + field->offset;
            for (size_t i = 0; i == 0 || i < field->repeats; i++) {
                if (!is_good(checker, field, at + i * field->step)) {
                    return refuse(field->name, row, error);
                }
            }
        }
    }
    return GLINT_OK;
}

// ---- What fields say together -------------------------------------------------------------------

// `count` pieces of `size` bytes, `stride` apart, at `offset`.
static bool range_fits(const glint_document *document, uint64_t offset, uint64_t count,
                       uint64_t size, uint64_t stride)
{
    const uint64_t bytes = document->bytes;
    return offset < bytes && count >= 1 && size <= bytes - offset &&
           (count - 1 <= (bytes - offset - size) / (stride > 0 ? stride : 1));
}

static uint32_t load_unsigned(const unsigned char *at, uint32_t bytes)
{
    uint32_t value = 0;
    memcpy(&value, at, bytes); // little-endian, as glTF is
    return value;
}

static bool sparse_fits(const glint_document *document, const glint_document_array *array,
                        uint64_t size)
{
    const uint32_t width = glint_component_bytes(array->sparse_type);
    if (array->sparse_type != GLINT_COMPONENT_UINT8 &&
        array->sparse_type != GLINT_COMPONENT_UINT16 &&
        array->sparse_type != GLINT_COMPONENT_UINT32) {
        return false;
    }
    if (!range_fits(document, array->sparse_indices, array->sparse_count, width, width) ||
        !range_fits(document, array->sparse_elements, array->sparse_count, size, size)) {
        return false;
    }
    uint64_t next = 0;
    for (uint32_t k = 0; k < array->sparse_count; k++) {
        const uint32_t index =
            load_unsigned(document->block + array->sparse_indices + (uint64_t)k * width, width);
        if (index < next || index >= array->count) {
            return false;
        }
        next = (uint64_t)index + 1;
    }
    return true;
}

static glint_status check_arrays(const glint_document *document, glint_error *error)
{
    uint64_t sparse = 0; // elements of all arrays, limited so that checking them ends soon
    for (size_t i = 0; i < document->arrays_count; i++) {
        const glint_document_array *array = &document->arrays[i];
        const uint64_t size =
            (uint64_t)glint_component_bytes(array->type) * (uint64_t)array->components;
        const bool is_there =
            (array->offset == 0 && array->count <= GLINT_ZEROS_MAX) ||
            (array->stride >= size &&
             range_fits(document, array->offset, array->count, size, array->stride));
        sparse += array->sparse_count;
        if (sparse > document->bytes || size == 0 || array->count == 0 || !is_there ||
            (array->sparse_count > 0 && !sparse_fits(document, array, size))) {
            return refuse("arrays", i, error);
        }
    }
    return GLINT_OK;
}

// Checks that children and parents agree and that there is no loop: each node is the child of its
// parent, once, and every way up ends.
static glint_status check_tree(const glint_document *document, glint_error *error)
{
    const size_t count = document->nodes_count;
    size_t children = 0, with_parents = 0, rooted = 0;
    int32_t *way = calloc(count + 1, sizeof *way);
    char *is_met = calloc(count + 1, 1); // as a child
    glint_status status =
        way == NULL || is_met == NULL ? glint_fail_memory(error, "the scene") : GLINT_OK;
    for (size_t i = 0; status == GLINT_OK && i < count; i++) {
        const glint_document_node *node = &document->nodes[i];
        with_parents += node->parent >= 0 ? 1 : 0;
        for (uint32_t c = 0; status == GLINT_OK && c < node->children.count; c++) {
            const int32_t child = document->node_lists[node->children.first + c];
            children++;
            if (is_met[child] != 0 || document->nodes[child].parent != (int32_t)i) {
                status = refuse("nodes.children", i, error);
            }
            is_met[child] = 1;
        }
    }
    // Walk down from the roots: in a loop nobody is met.
    size_t waiting = 0;
    for (size_t i = 0; status == GLINT_OK && i < count; i++) {
        if (document->nodes[i].parent < 0) {
            way[waiting++] = (int32_t)i;
        }
    }
    while (status == GLINT_OK && waiting > 0) {
        const glint_document_node *node = &document->nodes[way[--waiting]];
        rooted++;
        for (uint32_t c = 0; c < node->children.count; c++) {
            way[waiting++] = document->node_lists[node->children.first + c];
        }
    }
    if (status == GLINT_OK && (children != with_parents || rooted != count)) {
        status = refuse("nodes.parent", 0, error);
    }
    free(way);
    free(is_met);
    return status;
}

static uint64_t count_of(const glint_document *document, int32_t array)
{
    return array < 0 ? 0 : document->arrays[array].count;
}

// True if the array is missing, or has as many elements as there are vertices.
static bool agrees(const glint_document *document, int32_t array, uint64_t vertices)
{
    return array < 0 || (vertices > 0 && document->arrays[array].count == vertices);
}

static bool primitive_agrees(const glint_document *document,
                             const glint_document_primitive *primitive)
{
    const uint64_t vertices = count_of(document, primitive->positions);
    bool good = agrees(document, primitive->normals, vertices) &&
                agrees(document, primitive->tangents, vertices) &&
                agrees(document, primitive->colors, vertices) &&
                agrees(document, primitive->texcoords[0], vertices) &&
                agrees(document, primitive->texcoords[1], vertices) &&
                (primitive->indices < 0 || vertices > 0);
    for (uint32_t k = 0; k < primitive->targets.count; k++) {
        const glint_document_target *target = &document->targets[primitive->targets.first + k];
        good = good && agrees(document, target->positions, vertices) &&
               agrees(document, target->normals, vertices);
    }
    for (uint32_t k = 0; k < primitive->influences.count; k++) {
        const glint_document_influence *one =
            &document->influences[primitive->influences.first + k];
        good = good && one->joints >= 0 && one->weights >= 0 &&
               agrees(document, one->joints, vertices) && agrees(document, one->weights, vertices);
    }
    return good;
}

static bool instances_agree(const glint_document *document, const glint_document_node *node)
{
    uint64_t count = 0;
    for (int i = 0; i < 3; i++) {
        const uint64_t own = count_of(document, node->instances[i]);
        if (own > 0 && count > 0 && own != count) {
            return false;
        }
        count = own > 0 ? own : count;
    }
    return true;
}

static bool channel_agrees(const glint_document *document, const glint_document_channel *channel)
{
    static const int components[] = {[GLINT_PROPERTY_TRANSLATION] = 3,
                                     [GLINT_PROPERTY_ROTATION] = 4,
                                     [GLINT_PROPERTY_SCALE] = 3,
                                     [GLINT_PROPERTY_WEIGHTS] = 1};
    const glint_document_node *node = &document->nodes[channel->node];
    if (channel->input < 0 || channel->output < 0 ||
        document->arrays[channel->output].components < components[channel->property]) {
        return false;
    }
    uint64_t each = channel->interpolation == GLINT_INTERPOLATION_CUBIC ? 3 : 1;
    if (channel->property == GLINT_PROPERTY_WEIGHTS) {
        each *= node->mesh < 0 ? 0 : document->meshes[node->mesh].target_count;
    }
    const uint64_t keys = count_of(document, channel->input);
    const uint64_t values = count_of(document, channel->output);
    return each > 0 && values % each == 0 && values / each == keys;
}

static glint_status check_agreement(const glint_document *document, glint_error *error)
{
    for (size_t i = 0; i < document->primitives_count; i++) {
        if (!primitive_agrees(document, &document->primitives[i])) {
            return refuse("primitives", i, error);
        }
    }
    for (size_t i = 0; i < document->nodes_count; i++) {
        if (!instances_agree(document, &document->nodes[i])) {
            return refuse("nodes.instances", i, error);
        }
    }
    for (size_t i = 0; i < document->skins_count; i++) {
        const glint_document_skin *skin = &document->skins[i];
        if (skin->joints.count == 0 ||
            (skin->inverse_bind >= 0 &&
             count_of(document, skin->inverse_bind) < skin->joints.count)) {
            return refuse("skins", i, error);
        }
    }
    for (size_t i = 0; i < document->channels_count; i++) {
        if (!channel_agrees(document, &document->channels[i])) {
            return refuse("channels", i, error);
        }
    }
    for (size_t i = 0; i < document->images_count; i++) {
        const glint_document_image *image = &document->images[i];
        if (image->offset > document->bytes ||
            (image->bytes > 0 && !range_fits(document, image->offset, image->bytes, 1, 1))) {
            return refuse("images", i, error);
        }
    }
    return GLINT_OK;
}

// ---- Opening ------------------------------------------------------------------------------------

// Finds the tables. They must lie in the block; texts end with a zero.
static glint_status find_tables(glint_document *document, const glint_document_header *header,
                                glint_error *error)
{
    for (size_t t = 0; t < GLINT_TABLES; t++) {
        const glint_document_place *place = &header->tables[t];
        if (place->offset % 8 != 0 || place->offset > document->bytes ||
            place->count > (document->bytes - place->offset) / row_bytes[t] ||
            place->count > INT32_MAX) {
            return refuse("tables", t, error);
        }
    }
#define TABLE(name, type)                                                                          \
    document->name =                                                                               \
        (const type *)(const void *)(document->block + header->tables[GLINT_TABLE_##name].offset); \
    document->name##_count = header->tables[GLINT_TABLE_##name].count;
    GLINT_DOCUMENT_TABLES(TABLE)
#undef TABLE
    const size_t length = document->texts_count;
    if (length == 0 || document->texts[0] != '\0' || document->texts[length - 1] != '\0') {
        return refuse("texts", 0, error);
    }
    document->default_scene = header->default_scene;
    if (header->default_scene < -1 ||
        (int64_t)header->default_scene >= (int64_t)document->scenes_count) {
        return refuse("scene", 0, error);
    }
    return GLINT_OK;
}

static glint_status check(glint_document *document, glint_error *error)
{
    glint_document_header header;
    if (document->bytes < sizeof header) {
        return refuse("header", 0, error);
    }
    memcpy(&header, document->block, sizeof header);
    if (header.magic != GLINT_DOCUMENT_MAGIC) {
        return refuse("header", 0, error);
    }
    TRY(find_tables(document, &header, error));
    check_state checker = {document, header.tables, 0};
    TRY(check_fields(&checker, error));
    TRY(check_arrays(document, error));
    TRY(check_tree(document, error));
    return check_agreement(document, error);
}

// So that sums over all draws do not overflow.
static const off_t bytes_most = (off_t)1 << 40;

glint_status glint_document_open(int file, glint_document *document, glint_error *error)
{
    *document = (glint_document){0};
    struct stat facts;
    if (fstat(file, &facts) != 0 || facts.st_size <= 0 || facts.st_size > bytes_most) {
        return refuse("header", 0, error);
    }
    void *block = mmap(NULL, (size_t)facts.st_size, PROT_READ, MAP_SHARED, file, 0);
    if (block == MAP_FAILED) {
        return glint_fail(error, GLINT_OUT_OF_MEMORY, "its contents cannot be mapped: %s",
                          strerror(errno));
    }
    document->block = block;
    document->bytes = (size_t)facts.st_size;
    const glint_status status = check(document, error);
    if (status != GLINT_OK) {
        glint_document_close(document);
    }
    return status;
}

void glint_document_close(glint_document *document)
{
    if (document->block != NULL) {
        (void)munmap((void *)document->block, document->bytes);
    }
    *document = (glint_document){0};
}
