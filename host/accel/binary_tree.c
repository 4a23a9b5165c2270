// Builds the binary tree level by level: threads bin and divide the references in chunks. Sums over
// chunks are boxes and counts only. So neither the order of the chunks nor the number of threads
// changes the tree. See binary_tree.h.
#include "accel/binary_tree.h"

#include "accel/range.h"
#include "base/memory.h"
#include "base/parallel.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define CHUNK ((size_t)2048) // references of a chunk
// Ranges per thread, enough to keep all threads busy to the end. The tree does not depend on this
// number: one thread always builds a range of GLINT_BUNDLED_MIN triangles or fewer.
#define RANGES_PER_THREAD 8

_Static_assert(CHUNK % GLINT_BUNDLE_MAX == 0, "a bundle would lie across two chunks");

// A range, and the state of its division.
typedef struct entry {
    glint_range range;
    size_t children; // index of the left child's entry, the right one follows; 0: not divided
    glint_wide_costs costs;
    // Used while the range is being divided:
    glint_binning binning;
    glint_split split;
    bool has_split;
} entry;

// A part of a range; one thread works on it at a time.
typedef struct chunk {
    size_t entry, first, count;
    glint_reference *made; // references to the chunk's triangles, owned; used only at the start
    size_t made_count, made_triangles;
    size_t left_before, right_before; // references of earlier chunks on each side
    glint_bins bins;
    glint_box boxes[2]; // bounds and middles of its references; later the middles of each side
} chunk;

typedef struct builder {
    const glint_bvh_inputs *in;
    glint_reference *references, *spare;
    size_t range_max; // more triangles than this are divided by all threads together
    entry *entries;   // parents before children, level by level
    size_t entry_count, entry_capacity;
    chunk *chunks; // chunks of the entries that are being divided
    size_t chunk_count;
    glint_binary_tree *tree;
    atomic_bool failed;
} builder;

static bool add_entry(builder *b, const glint_range *range)
{
    if (b->entry_count == b->entry_capacity) {
        size_t capacity = b->entry_capacity > 0 ? 2 * b->entry_capacity : 256;
        entry *entries = glint_allocate_unset(capacity, sizeof *entries);
        if (entries == NULL) {
            return false;
        }
        if (b->entry_count > 0) {
            memcpy(entries, b->entries, b->entry_count * sizeof *entries);
        }
        free(b->entries);
        b->entries = entries;
        b->entry_capacity = capacity;
    }
    b->entries[b->entry_count++] = (entry){.range = *range};
    return true;
}

// Cuts the entries from `first` on into chunks if they are large enough to be divided.
static bool make_chunks(builder *b, size_t first)
{
    size_t count = 0;
    for (size_t i = first; i < b->entry_count; i++) {
        const glint_range *range = &b->entries[i].range;
        count += range->triangle_count > b->range_max ? (range->count + CHUNK - 1) / CHUNK : 0;
    }
    free(b->chunks);
    b->chunk_count = 0;
    b->chunks = glint_allocate_unset(count, sizeof *b->chunks);
    if (b->chunks == NULL) {
        return false;
    }
    for (size_t i = first; i < b->entry_count; i++) {
        const glint_range *range = &b->entries[i].range;
        size_t size = range->triangle_count > b->range_max ? range->count : 0;
        for (size_t at = 0; at < size; at += CHUNK) {
            chunk *c = &b->chunks[b->chunk_count++];
            c->entry = i;
            c->first = at;
            c->count = size - at < CHUNK ? size - at : CHUNK;
            c->made = NULL;
        }
    }
    return true;
}

// ---- The references ----------------------------------------------------------------------------

// Makes the references to a chunk of triangles, in the chunk's own memory: the total number of
// references is not known yet.
static void make_references(size_t index, void *context)
{
    builder *b = context;
    chunk *c = &b->chunks[index];
    glint_reference references[CHUNK];
    c->made_count = glint_references_make(b->in, c->first, c->count, references);
    c->made_triangles = 0;
    c->made = glint_allocate_unset(c->made_count, sizeof *c->made);
    if (c->made == NULL) {
        atomic_store(&b->failed, true);
        return;
    }
    memcpy(c->made, references, c->made_count * sizeof *c->made);
    c->boxes[0] = c->boxes[1] = glint_box_empty();
    for (size_t i = 0; i < c->made_count; i++) {
        glint_box middle = glint_box_of(glint_box_middle(references[i]));
        c->made_triangles += glint_reference_count(references[i]);
        c->boxes[0] = glint_box_union(c->boxes[0], references[i]);
        c->boxes[1] = glint_box_union(c->boxes[1], middle);
    }
}

static void gather_references(size_t index, void *context)
{
    builder *b = context;
    chunk *c = &b->chunks[index];
    memcpy(b->references + c->left_before, c->made, c->made_count * sizeof *c->made);
    free(c->made);
    c->made = NULL;
}

// Joins the references of all chunks into those of the first entry.
static bool join_chunks(builder *b, glint_range *all)
{
    all->node->bounds = all->middles = glint_box_empty();
    all->count = all->triangle_count = 0;
    for (size_t i = 0; i < b->chunk_count; i++) {
        chunk *c = &b->chunks[i];
        all->node->bounds = glint_box_union(all->node->bounds, c->boxes[0]);
        all->middles = glint_box_union(all->middles, c->boxes[1]);
        c->left_before = all->count;
        all->count += c->made_count;
        all->triangle_count += c->made_triangles;
    }
    b->references = glint_allocate_unset(all->count, sizeof *b->references);
    b->spare = glint_allocate_unset(all->count, sizeof *b->spare);
    if (b->references == NULL || b->spare == NULL) {
        return false;
    }
    all->references = b->references;
    all->spare = b->spare;
    glint_parallel_for_on(b->in->threads, b->chunk_count, gather_references, b);
    return true;
}

// Makes the first entry, which holds all triangles.
static bool start(builder *b)
{
    const size_t count = b->in->triangle_count;
    const glint_range all = {.node = &b->tree->root, .count = count, .triangle_count = count};
    b->range_max = 0; // cut everything into chunks this once
    if (!add_entry(b, &all) || !make_chunks(b, 0)) {
        return false;
    }
    glint_parallel_for_on(b->in->threads, b->chunk_count, make_references, b);
    bool made = !atomic_load(&b->failed) && join_chunks(b, &b->entries[0].range);
    b->tree->triangle_count = b->entries[0].range.triangle_count;
    for (size_t i = 0; i < b->chunk_count; i++) {
        free(b->chunks[i].made);
    }
    b->range_max = count / (RANGES_PER_THREAD * glint_parallel_threads(b->in->threads));
    b->range_max = b->range_max > GLINT_BUNDLED_MIN ? b->range_max : GLINT_BUNDLED_MIN;
    return made;
}

// ---- The upper levels --------------------------------------------------------------------------

static void bin_chunk(size_t index, void *context)
{
    builder *b = context;
    chunk *c = &b->chunks[index];
    const entry *e = &b->entries[c->entry];
    glint_bins_fill(&c->bins, &e->binning, e->range.references + c->first, c->count);
}

// Chooses the split of the entry whose chunks begin at `first`. Tells each chunk where its
// references go.
static void choose_split(builder *b, entry *e, size_t first)
{
    const size_t last = first + (e->range.count + CHUNK - 1) / CHUNK;
    glint_bins bins = b->chunks[first].bins;
    for (size_t i = first + 1; i < last; i++) {
        glint_bins_merge(&bins, &b->chunks[i].bins);
    }
    e->has_split = e->range.depth < GLINT_SAH_DEPTH_LIMIT &&
                   glint_split_find(&bins, e->range.node->bounds, &e->split);
    size_t left = 0;
    for (size_t i = first; e->has_split && i < last; i++) {
        chunk *c = &b->chunks[i];
        c->left_before = left;
        c->right_before = c->first - left;
        left += glint_bins_left_count(&c->bins, &e->split);
    }
}

static void divide_chunk(size_t index, void *context)
{
    builder *b = context;
    chunk *c = &b->chunks[index];
    const entry *e = &b->entries[c->entry];
    c->boxes[0] = c->boxes[1] = glint_box_empty();
    if (e->has_split) {
        glint_reference *left = e->range.spare;
        glint_reference *right = left + e->split.references[0];
        glint_split_sides to = {{left + c->left_before, right + c->right_before},
                                {c->boxes[0], c->boxes[1]}};
        glint_split_apply(&e->split, &e->binning, e->range.references + c->first, c->count, &to);
        c->boxes[0] = to.middles[0];
        c->boxes[1] = to.middles[1];
    }
}

// Makes the children of an entry after its references were divided.
static bool add_children(builder *b, size_t index, size_t first_chunk)
{
    const entry *e = &b->entries[index];
    glint_binary_node *children = glint_arena_take(&b->tree->arenas[0], 2 * sizeof *children);
    if (children == NULL) {
        return false;
    }
    glint_range sides[2];
    if (e->has_split) {
        glint_box middles[2] = {glint_box_empty(), glint_box_empty()};
        for (size_t i = first_chunk; i < b->chunk_count && b->chunks[i].entry == index; i++) {
            middles[0] = glint_box_union(middles[0], b->chunks[i].boxes[0]);
            middles[1] = glint_box_union(middles[1], b->chunks[i].boxes[1]);
        }
        glint_range_divide(&e->range, &e->split, middles, children, sides);
    } else {
        glint_range_halve(&e->range, children, sides);
    }
    e->range.node->children = children;
    b->entries[index].children = b->entry_count;
    return add_entry(b, &sides[0]) && add_entry(b, &sides[1]);
}

// Divides the entries from `first` on that are too large for one thread.
static bool divide_level(builder *b, size_t first)
{
    if (!make_chunks(b, first)) {
        return false;
    }
    for (size_t i = first; i < b->entry_count; i++) {
        b->entries[i].binning = glint_binning_of(b->entries[i].range.middles);
    }
    glint_parallel_for_on(b->in->threads, b->chunk_count, bin_chunk, b);
    for (size_t i = 0; i < b->chunk_count; i++) {
        if (b->chunks[i].first == 0) {
            choose_split(b, &b->entries[b->chunks[i].entry], i);
        }
    }
    glint_parallel_for_on(b->in->threads, b->chunk_count, divide_chunk, b);
    for (size_t i = 0; i < b->chunk_count; i++) {
        if (b->chunks[i].first == 0 && !add_children(b, b->chunks[i].entry, i)) {
            return false;
        }
    }
    return true;
}

// ---- The whole tree ----------------------------------------------------------------------------

static void build_range(size_t index, void *context)
{
    builder *b = context;
    entry *e = &b->entries[index];
    if (e->children == 0 &&
        !glint_range_build(b->in, &e->range, &b->tree->arenas[index], &e->costs)) {
        atomic_store(&b->failed, true);
    }
}

static bool divide_upper_levels(builder *b)
{
    size_t first = 0;
    do {
        size_t next = b->entry_count;
        if (!divide_level(b, first)) {
            return false;
        }
        first = next;
    } while (first < b->entry_count);
    return true;
}

static bool build_ranges(builder *b)
{
    // One arena per range, so that no two threads share one. The upper nodes keep the first arena.
    glint_arena *arenas = glint_allocate(b->entry_count, sizeof *arenas);
    if (arenas == NULL) {
        return false;
    }
    arenas[0] = b->tree->arenas[0];
    free(b->tree->arenas);
    b->tree->arenas = arenas;
    b->tree->arena_count = b->entry_count;
    glint_parallel_for_on(b->in->threads, b->entry_count, build_range, b);
    if (atomic_load(&b->failed)) {
        return false;
    }
    for (size_t i = b->entry_count; i-- > 0;) {
        entry *e = &b->entries[i];
        if (e->children > 0) {
            e->costs =
                glint_wide_costs_join(e->range.node, b->in->width, &b->entries[e->children].costs,
                                      &b->entries[e->children + 1].costs);
        }
    }
    b->tree->costs = b->entries[0].costs;
    return true;
}

bool glint_binary_tree_build(const glint_bvh_inputs *in, glint_binary_tree *tree)
{
    *tree = (glint_binary_tree){.arena_count = 1};
    builder b = {.in = in, .tree = tree};
    tree->arenas = glint_allocate(1, sizeof *tree->arenas);
    bool done = tree->arenas != NULL && start(&b) &&
                (tree->triangle_count == 0 || (divide_upper_levels(&b) && build_ranges(&b)));
    free(b.references);
    free(b.spare);
    free(b.entries);
    free(b.chunks);
    return done;
}

void glint_binary_tree_free(glint_binary_tree *tree)
{
    for (size_t i = 0; tree->arenas != NULL && i < tree->arena_count; i++) {
        glint_arena_free(&tree->arenas[i]);
    }
    free(tree->arenas);
    *tree = (glint_binary_tree){0};
}
