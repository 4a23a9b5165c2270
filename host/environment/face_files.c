// Finds the six files that are the faces of a cube, by their names. See face_files.h.
//
// A set of files has a common beginning before the face's name, one kind of names and a common
// extension. glint uses the one complete set. It refuses a folder or pattern with several or none.
#include "environment/face_files.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#define KINDS 5
static const char *const face_names[KINDS][6] = {
    {"posx", "negx", "posy", "negy", "posz", "negz"},
    {"px", "nx", "py", "ny", "pz", "nz"},
    {"right", "left", "top", "bottom", "front", "back"},
    {"right", "left", "up", "down", "front", "back"},
    {"+x", "-x", "+y", "-y", "+z", "-z"},
};
#define KIND_SIGNS 4 // signs need no mark between them and the text before

void glint_face_files_free(glint_face_files *files)
{
    for (int face = 0; face < 6; face++) {
        free(files->paths[face]);
    }
    *files = (glint_face_files){0};
}

static int count_found(const glint_face_files *files)
{
    int found = 0;
    for (int face = 0; face < 6; face++) {
        found += files->paths[face] != NULL;
    }
    return found;
}

static bool is_regular(const char *path)
{
    struct stat facts;
    return stat(path, &facts) == 0 && S_ISREG(facts.st_mode);
}

static bool is_same_file(const char *a, const char *b)
{
    struct stat of_a, of_b;
    return stat(a, &of_a) == 0 && stat(b, &of_b) == 0 && of_a.st_dev == of_b.st_dev &&
           of_a.st_ino == of_b.st_ino;
}

// ---- A pattern ----------------------------------------------------------------------------------

typedef enum letters { SMALL, CAPITAL, CAPITALISED, LAST_CAPITAL, LETTERS } letters;

// Spells "posx" as posx, POSX, Posx or posX. For "right" it also gives righT, a harmless spelling
// that nobody uses.
static void spell(const char *name, letters how, char spelled[16])
{
    size_t length = strlen(name);
    for (size_t i = 0; i <= length; i++) {
        bool up = how == CAPITAL || (how == CAPITALISED && i == 0) ||
                  (how == LAST_CAPITAL && i + 1 == length);
        spelled[i] = (char)(up ? toupper((unsigned char)name[i]) : name[i]);
    }
}

// Fills `files` with the existing files of the set.
static void try_spelling(const char *pattern, int kind, letters how, glint_face_files *files)
{
    const char *gap = strstr(pattern, "%s");
    for (int face = 0; face < 6; face++) {
        char name[16], path[PATH_MAX];
        spell(face_names[kind][face], how, name);
        int printed =
            snprintf(path, sizeof path, "%.*s%s%s", (int)(gap - pattern), pattern, name, gap + 2);
        if (printed > 0 && (size_t)printed < sizeof path && is_regular(path)) {
            files->paths[face] = strdup(path);
        }
    }
}

static glint_status refuse_incomplete(const char *given, const char *missing, int found,
                                      glint_error *error)
{
    if (found == 0) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: no faces there (name them posx negx posy negy posz negz, px nx …, "
                          "right left top bottom front back, or +x -x …)",
                          given);
    }
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%s: %d of six faces are there, the first that is missing is %s (add it)",
                      given, found, missing);
}

static glint_status refuse_ambiguous(const char *given, const char *one, const char *other,
                                     glint_error *error)
{
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%s: more than one set of six faces: %s and %s (give a pattern such as "
                      "sky_%%s.png, or a folder with one set)",
                      given, one, other);
}

// Keeps the better of two sets. Complains if both are complete and are different files. (On a file
// system that ignores case, two spellings name the same files.)
static glint_status keep_better(const char *given, glint_face_files *best, glint_face_files *other,
                                glint_error *error)
{
    int found = count_found(best), more = count_found(other);
    glint_status status = GLINT_OK;
    const char *one = best->paths[0], *two = other->paths[0];
    if (found == 6 && more == 6 && one != NULL && two != NULL && !is_same_file(one, two)) {
        status = refuse_ambiguous(given, one, two, error);
    } else if (more > found) {
        glint_face_files swap = *best;
        *best = *other;
        *other = swap;
    }
    glint_face_files_free(other);
    return status;
}

static void name_missing(const glint_face_files *files, int kind, char *missing, size_t size)
{
    for (int face = 5; face >= 0; face--) {
        if (files->paths[face] == NULL) {
            snprintf(missing, size, "%s", face_names[kind][face]);
        }
    }
}

glint_status glint_face_files_by_pattern(const char *pattern, glint_face_files *files,
                                         glint_error *error)
{
    *files = (glint_face_files){0};
    const char *gap = strstr(pattern, "%s");
    if (gap == NULL || strstr(gap + 2, "%s") != NULL) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: a pattern holds %%s once, for the face's name", pattern);
    }
    char missing[16] = "";
    for (int kind = 0; kind < KINDS; kind++) {
        for (letters how = SMALL; how < LETTERS; how++) {
            glint_face_files found = {0};
            try_spelling(pattern, kind, how, &found);
            if (count_found(&found) > count_found(files)) {
                name_missing(&found, kind, missing, sizeof missing);
            }
            glint_status status = keep_better(pattern, files, &found, error);
            if (status != GLINT_OK) {
                glint_face_files_free(files);
                return status;
            }
        }
    }
    int found = count_found(files);
    if (found < 6) {
        glint_face_files_free(files);
        return refuse_incomplete(pattern, missing, found, error);
    }
    return GLINT_OK;
}

// ---- A folder -----------------------------------------------------------------------------------

// A set of files while it is collected.
typedef struct set {
    int kind;
    char *before;    // text before the face's name
    char *extension; // with its dot
    glint_face_files files;
} set;

typedef struct sets {
    set *items;
    size_t count;
} sets;

static void sets_free(sets *all)
{
    for (size_t k = 0; k < all->count; k++) {
        free(all->items[k].before);
        free(all->items[k].extension);
        glint_face_files_free(&all->items[k].files);
    }
    free(all->items);
    *all = (sets){0};
}

// True if `stem` ends with the name of this face, and the text before it is empty or ends with a
// mark. A sign needs no mark.
static bool ends_with_face(const char *stem, size_t length, int kind, int face)
{
    size_t part = strlen(face_names[kind][face]);
    if (length < part || strncasecmp(stem + length - part, face_names[kind][face], part) != 0) {
        return false;
    }
    return length == part || kind == KIND_SIGNS || strchr("_-. ", stem[length - part - 1]) != NULL;
}

// Finds or adds the set of this kind, beginning and extension. NULL if there is no memory.
static set *find_set(sets *all, const set *wanted, size_t before_length)
{
    for (size_t k = 0; k < all->count; k++) {
        set *known = &all->items[k];
        if (known->kind == wanted->kind && strlen(known->before) == before_length &&
            strncmp(known->before, wanted->before, before_length) == 0 &&
            strcmp(known->extension, wanted->extension) == 0) {
            return known;
        }
    }
    set *items = realloc(all->items, (all->count + 1) * sizeof(set));
    if (items == NULL) {
        return NULL;
    }
    all->items = items;
    set *added = &items[all->count];
    *added = (set){.kind = wanted->kind,
                   .before = strndup(wanted->before, before_length),
                   .extension = strdup(wanted->extension)};
    all->count++;
    return added->before != NULL && added->extension != NULL ? added : NULL;
}

static bool add_file(sets *all, const char *folder, const char *name)
{
    const char *dot = strrchr(name, '.');
    if (dot == NULL || dot == name) {
        return true;
    }
    size_t length = (size_t)(dot - name);
    char path[PATH_MAX];
    int printed = snprintf(path, sizeof path, "%s/%s", folder, name);
    for (int kind = 0; kind < KINDS; kind++) {
        for (int face = 0; face < 6; face++) {
            if (!ends_with_face(name, length, kind, face) || printed < 0 ||
                (size_t)printed >= sizeof path || !is_regular(path)) {
                continue;
            }
            // The pointers only describe the wanted set.
            set wanted = {.kind = kind, .before = (char *)name, .extension = (char *)dot};
            set *found = find_set(all, &wanted, length - strlen(face_names[kind][face]));
            if (found == NULL) {
                return false;
            }
            if (found->files.paths[face] == NULL) {
                found->files.paths[face] = strdup(path);
            }
        }
    }
    return true;
}

static glint_status list_folder(const char *folder, sets *all, glint_error *error)
{
    DIR *listing = opendir(folder);
    if (listing == NULL) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: %s (check its permissions)", folder,
                          strerror(errno));
    }
    bool has_memory = true;
    for (struct dirent *entry = readdir(listing); entry != NULL && has_memory;
         entry = readdir(listing)) {
        has_memory = entry->d_name[0] == '.' || add_file(all, folder, entry->d_name);
    }
    closedir(listing);
    return has_memory ? GLINT_OK : glint_fail_memory(error, "file names");
}

glint_status glint_face_files_in_folder(const char *folder, glint_face_files *files,
                                        glint_error *error)
{
    *files = (glint_face_files){0};
    sets all = {0};
    char missing[16] = "";
    glint_status status;
    TRY_OR(cleanup, status, list_folder(folder, &all, error));
    for (size_t k = 0; k < all.count; k++) {
        if (count_found(&all.items[k].files) > count_found(files)) {
            name_missing(&all.items[k].files, all.items[k].kind, missing, sizeof missing);
        }
        TRY_OR(cleanup, status, keep_better(folder, files, &all.items[k].files, error));
    }
    const int found = count_found(files);
    if (found < 6) {
        status = refuse_incomplete(folder, missing, found, error);
    }
cleanup:
    if (status != GLINT_OK) {
        glint_face_files_free(files);
    }
    sets_free(&all);
    return status;
}
