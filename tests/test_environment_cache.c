// Tests the cache of environments: what is kept, and that a cache that is damaged, full, read-only,
// shared or out of date never changes what is loaded. The judge is the same file, loaded without a
// cache.
#include "base/cache_folder.h"
#include "environment/cache.h"
#include "environment/cached_irradiance.h"
#include "environment/environment.h"
#include "environment/irradiance.h"
#include "image/image_io.h"
#include "support/direction_maps.h"
#include "support/scratch.h"

#include <dirent.h>
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#define ROWS 512 // of a map: the least whose cube is kept
#define EDGE 512
#define ENTRY_MIB 25 // of its entry, rounded up

// ---- Files --------------------------------------------------------------------------------------

// Sets the time of modification, in seconds before now. Fresh files are not kept.
static void age(const char *path, int seconds)
{
    const struct timespec times[2] = {{time(NULL) - seconds, 0}, {time(NULL) - seconds, 0}};
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
}

// Writes a lat-long map of one colour with a mark, and makes it old. Returns its path, in one of
// four buffers that are used in turn.
static const char *write_map(const char *name, int width, float value)
{
    static char paths[4][PATH_MAX];
    static int turn;
    char *path = paths[turn++ % 4];
    snprintf(path, PATH_MAX, "%s", scratch_path(name));
    glint_image image;
    assert_int_equal(glint_image_create(width, ROWS, 3, &image, NULL), GLINT_OK);
    for (int k = 0; k < 3 * width * ROWS; k++) {
        image.pixels[k] = k % 997 == 0 ? 2 * value : value;
    }
    assert_int_equal(glint_image_write(path, &image, NULL, NULL), GLINT_OK);
    glint_image_free(&image);
    age(path, 100);
    return path;
}

static glint_environment load(const char *path)
{
    glint_environment environment;
    glint_error error = {0};
    if (glint_environment_load(path, NULL, &environment, NULL, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    glint_environment_end_write(&environment); // the entry is complete
    return environment;
}

static bool is_of_cache(const glint_environment *environment)
{
    return environment->radiance.mapped_from > 0;
}

static void assert_alike(const glint_environment *a, const glint_environment *b)
{
    assert_string_equal(a->name, b->name);
    assert_int_equal(a->layout, b->layout);
    assert_string_equal(a->reason, b->reason);
    assert_int_equal(a->source_width, b->source_width);
    assert_int_equal(a->source_height, b->source_height);
    assert_int_equal(a->radiance.edge, b->radiance.edge);
    assert_memory_equal(a->radiance.texels, b->radiance.texels,
                        glint_cube_size(&a->radiance) * sizeof(float));
}

// Loads without a cache.
static glint_environment load_plainly(const char *path)
{
    setenv("GLINT_ENV_CACHE_MIB", "0", 1);
    glint_environment environment = load(path);
    unsetenv("GLINT_ENV_CACHE_MIB");
    assert_false(is_of_cache(&environment));
    return environment;
}

// Loads, and compares with a load without a cache. Says whether the cache had it.
static bool load_like(const char *path, const glint_environment *plain)
{
    glint_environment found = load(path);
    const bool was_kept = is_of_cache(&found);
    assert_alike(&found, plain);
    glint_environment_free(&found);
    return was_kept;
}

static bool load_and_compare(const char *path)
{
    glint_environment plain = load_plainly(path);
    const bool was_kept = load_like(path, &plain);
    glint_environment_free(&plain);
    return was_kept;
}

// ---- Entries ------------------------------------------------------------------------------------

// Counts the files of the cache whose names contain `part`; `path` receives the last one.
static int count_files(const char *part, char path[PATH_MAX])
{
    DIR *folder = opendir(scratch_path("cache/environments"));
    int count = 0;
    for (const struct dirent *at; folder != NULL && (at = readdir(folder)) != NULL;) {
        if (at->d_name[0] != '.' ? strstr(at->d_name, part) != NULL
                                 : strstr(at->d_name, "tmp") != NULL && strcmp(part, "tmp") == 0) {
            count++;
            if (path != NULL) {
                snprintf(path, PATH_MAX, "%s/%s", scratch_path("cache/environments"), at->d_name);
            }
        }
    }
    if (folder != NULL) {
        closedir(folder);
    }
    return count;
}

static void the_only_entry(char path[PATH_MAX])
{
    assert_int_equal(count_files(".cube", path), 1);
}

static int setup(void **state)
{
    const int status = scratch_setup(state);
    setenv("GLINT_CACHE_DIR", scratch_path("cache"), 1);
    unsetenv("GLINT_ENV_CACHE_MIB");
    return status;
}

// ---- What is kept -------------------------------------------------------------------------------

static void the_second_load_is_the_first_one(void **state)
{
    (void)state;
    const char *path = write_map("map.exr", 2 * ROWS, 0.5f);
    assert_false(glint_env_cache_may_have(path));
    assert_false(load_and_compare(path));
    assert_true(glint_env_cache_may_have(path));
    assert_true(load_and_compare(path));
    assert_int_equal(count_files("tmp", NULL), 0);
    // The name of a file does not matter, and the entry has no other's name.
    assert_int_equal(rename(path, scratch_path("other.exr")), 0);
    assert_true(load_and_compare(scratch_path("other.exr")));
}

static void six_faces_are_kept(void **state)
{
    (void)state;
    static const char *const names[6] = {"posx", "negx", "posy", "negy", "posz", "negz"};
    char path[64];
    assert_int_equal(mkdir(scratch_path("faces"), 0777), 0);
    for (int face = 0; face < 6; face++) {
        glint_image image;
        assert_int_equal(glint_image_create(EDGE, EDGE, 3, &image, NULL), GLINT_OK);
        for (int k = 0; k < 3 * EDGE * EDGE; k++) {
            image.pixels[k] = (float)(face + k % 3);
        }
        snprintf(path, sizeof path, "faces/%s.exr", names[face]);
        assert_int_equal(glint_image_write(scratch_path(path), &image, NULL, NULL), GLINT_OK);
        glint_image_free(&image);
        age(scratch_path(path), 100);
    }
    assert_false(load_and_compare(scratch_path("faces")));
    assert_true(load_and_compare(scratch_path("faces")));
    assert_false(load_and_compare(scratch_path("faces/%s.exr"))); // for another reason
    assert_true(load_and_compare(scratch_path("faces/%s.exr")));
    assert_int_equal(rename(scratch_path("faces/posx.exr"), scratch_path("faces/p")), 0);
    assert_int_equal(rename(scratch_path("faces/negx.exr"), scratch_path("faces/posx.exr")), 0);
    assert_int_equal(rename(scratch_path("faces/p"), scratch_path("faces/negx.exr")), 0);
    assert_false(load_and_compare(scratch_path("faces")));
}

static void another_request_has_its_own_entry(void **state)
{
    (void)state;
    const char *path = write_map("map.exr", 2 * ROWS, 0.5f);
    const glint_layout_request ball = {.layout = GLINT_LAYOUT_BALL};
    assert_false(load_and_compare(path));
    for (int k = 0; k < 2; k++) {
        glint_environment environment;
        assert_int_equal(glint_environment_load(path, &ball, &environment, NULL, NULL), GLINT_OK);
        assert_int_equal(environment.layout, GLINT_LAYOUT_BALL);
        assert_string_equal(environment.reason, "as asked");
        glint_environment_free(&environment);
    }
    assert_true(load_and_compare(path));
}

static void a_file_that_changes_is_loaded_anew(void **state)
{
    (void)state;
    const char *path = write_map("map.hdr", 2 * ROWS, 0.5f);
    struct stat before, after;
    assert_int_equal(stat(path, &before), 0);
    assert_false(load_and_compare(path));
    // The same size and time of modification.
    (void)write_map("map.hdr", 2 * ROWS, 0.75f);
    assert_int_equal(stat(path, &after), 0);
    assert_int_equal(after.st_size, before.st_size);
    const struct timespec times[2] = {before.st_mtim, before.st_mtim};
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
    assert_false(load_and_compare(path));
    assert_true(load_and_compare(path));
}

// A file may be written again within the clock's resolution.
static void a_fresh_file_is_not_kept(void **state)
{
    (void)state;
    const char *path = write_map("map.exr", 2 * ROWS, 0.5f);
    age(path, 0);
    assert_false(load_and_compare(path));
    assert_false(load_and_compare(path));
    assert_int_equal(count_files(".cube", NULL), 0);
}

static void what_was_warned_of_warns_again(void **state)
{
    (void)state;
    // A stretched map is not kept; integers are.
    const char *stretched = write_map("map.exr", 2 * ROWS - 1, 0.5f);
    const char *integers = write_map("map.png", 2 * ROWS, 0.5f);
    const glint_layout_request request = {.layout = GLINT_LAYOUT_LATLONG};
    for (int k = 0; k < 4; k++) {
        glint_environment environment;
        glint_warnings warnings = {0};
        assert_int_equal(glint_environment_load(k < 2 ? stretched : integers, &request,
                                                &environment, &warnings, NULL),
                         GLINT_OK);
        assert_int_equal(is_of_cache(&environment), k == 3);
        assert_int_equal(warnings.count, 1);
        assert_non_null(strstr(warnings.texts[0], k < 2 ? "stretched" : "8-bit integers"));
        glint_warnings_free(&warnings);
        glint_environment_free(&environment);
    }
}

static void changes_of_texels_stay_in_memory(void **state)
{
    (void)state;
    const char *path = write_map("map.exr", 2 * ROWS, 0.5f);
    glint_environment first = load(path), second = load(path);
    assert_true(is_of_cache(&second));
    assert_int_equal(glint_cube_mirror(&first.radiance, "xz", NULL), GLINT_OK);
    memset(second.radiance.texels, 0, glint_cube_size(&second.radiance) * sizeof(float));
    assert_int_equal(glint_cube_mirror(&second.radiance, "xz", NULL), GLINT_OK);
    glint_environment_free(&first);
    glint_environment_free(&second);
    assert_true(load_and_compare(path));
}

static void irradiance_is_kept(void **state)
{
    (void)state;
    glint_environment environment = load(write_map("map.exr", 2 * ROWS, 0.5f));
    glint_cube plain;
    assert_int_equal(glint_irradiance_map(&environment.radiance, 16, &plain, NULL), GLINT_OK);
    for (int k = 0; k < 2; k++) {
        glint_cube kept;
        assert_int_equal(glint_irradiance_map_cached(&environment.radiance, 16, &kept, NULL),
                         GLINT_OK);
        assert_true((kept.mapped_from > 0) == (k == 1));
        assert_memory_equal(kept.texels, plain.texels, glint_cube_size(&plain) * sizeof(float));
        glint_cube_free(&kept);
    }
    glint_cube_texel(&environment.radiance, 3, 1, 1)[0] = 9;
    glint_cube other;
    assert_int_equal(glint_irradiance_map_cached(&environment.radiance, 16, &other, NULL),
                     GLINT_OK);
    assert_int_equal(other.mapped_from, 0);
    glint_cube_free(&other);
    glint_cube_free(&plain);
    glint_environment_free(&environment);
}

// ---- Damage -------------------------------------------------------------------------------------

// Loads a map, so that the cache has one entry. Returns the map's path.
static const char *keep_one(glint_environment *plain, char entry[PATH_MAX], long long *bytes)
{
    const char *path = write_map("map.exr", 2 * ROWS, 0.5f);
    *plain = load_plainly(path);
    assert_false(load_like(path, plain));
    the_only_entry(entry);
    struct stat facts;
    assert_int_equal(stat(entry, &facts), 0);
    *bytes = facts.st_size;
    return path;
}

static void a_damaged_entry_is_replaced(void **state)
{
    (void)state;
    glint_environment plain;
    char entry[PATH_MAX];
    long long bytes = 0;
    const char *path = keep_one(&plain, entry, &bytes);
    // The header's members, its checksum, the first texel, texels in the middle, the last one.
    const long long places[] = {0, 8, 12, 16, 32, 40, 48, 71, 4096, 4096 + (9 << 20), bytes - 1};
    for (size_t k = 0; k < sizeof places / sizeof places[0]; k++) {
        const int file = open(entry, O_RDWR);
        unsigned char byte = 0;
        assert_int_equal(pread(file, &byte, 1, places[k]), 1);
        byte ^= 0x10;
        assert_int_equal(pwrite(file, &byte, 1, places[k]), 1);
        close(file);
        assert_false(load_like(path, &plain));
        assert_true(load_like(path, &plain));
    }
    glint_environment_free(&plain);
}

static void an_entry_of_another_length_is_replaced(void **state)
{
    (void)state;
    glint_environment plain;
    char entry[PATH_MAX];
    long long bytes = 0;
    const char *path = keep_one(&plain, entry, &bytes);
    const long long lengths[] = {0, 1, 70, 4096, bytes / 2, bytes - 1, bytes + 1};
    for (size_t k = 0; k < sizeof lengths / sizeof lengths[0]; k++) {
        assert_int_equal(truncate(entry, lengths[k]), 0);
        assert_false(load_like(path, &plain));
        assert_true(load_like(path, &plain));
    }
    glint_environment_free(&plain);
}

static void a_folder_that_cannot_be_written_is_no_error(void **state)
{
    (void)state;
    const char *path = write_map("map.exr", 2 * ROWS, 0.5f);
    scratch_write("file", "no folder", -1);
    setenv("GLINT_CACHE_DIR", scratch_path("file"), 1);
    assert_false(load_and_compare(path));
    setenv("GLINT_CACHE_DIR", "/proc/nowhere", 1);
    assert_false(load_and_compare(path));
    setenv("GLINT_CACHE_DIR", "", 1);
    assert_false(load_and_compare(path));
    setenv("GLINT_CACHE_DIR", scratch_path("cache"), 1);
    assert_false(load_and_compare(path));
    if (geteuid() != 0) { // root may write everywhere
        assert_int_equal(chmod(scratch_path("cache/environments"), 0500), 0);
        assert_true(load_and_compare(path));
        assert_false(load_and_compare(write_map("new.exr", 2 * ROWS, 0.25f)));
        assert_int_equal(chmod(scratch_path("cache/environments"), 0700), 0);
    }
}

// A limit on the size of files stands for a disk that becomes full while an entry is written.
static void a_full_disk_leaves_nothing_behind(void **state)
{
    (void)state;
    const char *path = write_map("map.exr", 2 * ROWS, 0.5f);
    glint_environment plain = load_plainly(path); // the decoder runs without the limit
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    const struct rlimit small = {1 << 20, before.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    glint_environment found = load(path);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_alike(&found, &plain);
    glint_environment_free(&found);
    glint_environment_free(&plain);
    assert_int_equal(count_files("", NULL) + count_files("tmp", NULL), 0);
    assert_false(load_and_compare(path));
}

// ---- The limit ----------------------------------------------------------------------------------

static bool load_within(const char *path, const char *mib)
{
    setenv("GLINT_ENV_CACHE_MIB", mib, 1);
    glint_environment environment = load(path);
    const bool was_kept = is_of_cache(&environment);
    glint_environment_free(&environment);
    unsetenv("GLINT_ENV_CACHE_MIB");
    return was_kept;
}

static void the_least_recently_used_entry_goes_first(void **state)
{
    (void)state;
    char one[PATH_MAX], two[PATH_MAX];
    const char *a = write_map("a.exr", 2 * ROWS, 0.25f);
    assert_false(load_within(a, "60"));
    the_only_entry(one);
    age(one, 50);
    const char *b = write_map("b.exr", 2 * ROWS, 0.5f);
    assert_false(load_within(b, "60"));
    assert_int_equal(count_files(".cube", NULL), 2);
    assert_true(load_within(b, "60"));
    assert_int_equal(count_files(".cube", two), 2);
    // Use makes the older entry the newer one.
    assert_true(load_within(a, "60"));
    char other[PATH_MAX];
    DIR *folder = opendir(scratch_path("cache/environments"));
    for (const struct dirent *at; (at = readdir(folder)) != NULL;) {
        snprintf(other, sizeof other, "%s/%s", scratch_path("cache/environments"), at->d_name);
        if (at->d_name[0] != '.' && strcmp(other, one) != 0) {
            age(other, 20);
        }
    }
    closedir(folder);
    const char *c = write_map("c.exr", 2 * ROWS, 1.0f);
    assert_false(load_within(c, "60"));
    assert_int_equal(count_files(".cube", NULL), 2);
    assert_true(load_within(a, "60"));
    assert_true(load_within(c, "60"));
    assert_false(load_within(b, "60"));
}

static void what_is_too_large_is_not_kept(void **state)
{
    (void)state;
    char limit[16];
    const char *path = write_map("map.exr", 2 * ROWS, 0.5f);
    snprintf(limit, sizeof limit, "%d", GLINT_ENV_CACHE_SHARE * (ENTRY_MIB - 1));
    assert_false(load_within(path, limit));
    assert_false(load_within(path, limit));
    assert_false(load_within(path, "0"));
    assert_int_equal(count_files(".cube", NULL), 0);
    snprintf(limit, sizeof limit, "%d", GLINT_ENV_CACHE_SHARE * ENTRY_MIB);
    assert_false(load_within(path, limit));
    assert_true(load_within(path, limit));
    assert_true(load_within(path, "nonsense")); // the usual limit
}

static void what_a_killed_process_left_goes(void **state)
{
    (void)state;
    const char *path = write_map("map.exr", 2 * ROWS, 0.5f);
    assert_int_equal(mkdir(scratch_path("cache"), 0700), 0);
    assert_int_equal(mkdir(scratch_path("cache/environments"), 0700), 0);
    scratch_write("cache/environments/.tmp-old", "half an entry", -1);
    scratch_write("cache/environments/.tmp-new", "half an entry", -1);
    age(scratch_path("cache/environments/.tmp-old"), 3600);
    assert_false(load_and_compare(path));
    assert_int_not_equal(access(scratch_path("cache/environments/.tmp-old"), F_OK), 0);
    assert_int_equal(access(scratch_path("cache/environments/.tmp-new"), F_OK), 0);
    assert_true(load_and_compare(path));
}

// ---- Processes ----------------------------------------------------------------------------------

static void processes_share_the_cache(void **state)
{
    (void)state;
    enum { PROCESSES = 4 };
    const char *path = write_map("map.exr", 2 * ROWS, 0.5f);
    glint_environment plain = load_plainly(path);
    pid_t processes[PROCESSES];
    for (int k = 0; k < PROCESSES; k++) {
        processes[k] = fork();
        if (processes[k] == 0) {
            bool is_same = true;
            for (int round = 0; round < 3 && is_same; round++) {
                glint_environment found;
                is_same = glint_environment_load(path, NULL, &found, NULL, NULL) == GLINT_OK &&
                          memcmp(found.radiance.texels, plain.radiance.texels,
                                 glint_cube_size(&plain.radiance) * sizeof(float)) == 0;
                glint_environment_free(&found);
            }
            _exit(is_same ? 0 : 1);
        }
    }
    for (int k = 0; k < PROCESSES; k++) {
        int how;
        assert_int_equal(waitpid(processes[k], &how, 0), processes[k]);
        assert_true(WIFEXITED(how) && WEXITSTATUS(how) == 0);
    }
    glint_environment_free(&plain);
    assert_int_equal(count_files(".cube", NULL), 1);
    assert_int_equal(count_files("tmp", NULL), 0);
    assert_true(load_and_compare(path));
}

// ---- The folder ---------------------------------------------------------------------------------

static void the_folder_follows_the_variables(void **state)
{
    (void)state;
    char path[PATH_MAX];
    setenv("GLINT_CACHE_DIR", "/a", 1);
    setenv("XDG_CACHE_HOME", "/b", 1);
    setenv("HOME", "/c", 1);
    assert_true(glint_cache_folder_find("name", path));
    assert_string_equal(path, "/a/name");
    setenv("GLINT_CACHE_DIR", "", 1);
    assert_false(glint_cache_folder_find("name", path));
    unsetenv("GLINT_CACHE_DIR");
    assert_true(glint_cache_folder_find("name", path));
    assert_string_equal(path, "/b/glint/name");
    setenv("XDG_CACHE_HOME", "relative", 1);
    assert_true(glint_cache_folder_find("name", path));
    assert_string_equal(path, "/c/.cache/glint/name");
    unsetenv("XDG_CACHE_HOME");
    assert_true(glint_cache_folder_find("name", path));
    assert_string_equal(path, "/c/.cache/glint/name");
    unsetenv("HOME");
    assert_false(glint_cache_folder_find("name", path));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, setup, scratch_teardown)
        IN_FOLDER(the_second_load_is_the_first_one),
        IN_FOLDER(six_faces_are_kept),
        IN_FOLDER(another_request_has_its_own_entry),
        IN_FOLDER(a_file_that_changes_is_loaded_anew),
        IN_FOLDER(a_fresh_file_is_not_kept),
        IN_FOLDER(what_was_warned_of_warns_again),
        IN_FOLDER(changes_of_texels_stay_in_memory),
        IN_FOLDER(irradiance_is_kept),
        IN_FOLDER(a_damaged_entry_is_replaced),
        IN_FOLDER(an_entry_of_another_length_is_replaced),
        IN_FOLDER(a_folder_that_cannot_be_written_is_no_error),
        IN_FOLDER(a_full_disk_leaves_nothing_behind),
        IN_FOLDER(the_least_recently_used_entry_goes_first),
        IN_FOLDER(what_is_too_large_is_not_kept),
        IN_FOLDER(what_a_killed_process_left_goes),
        IN_FOLDER(processes_share_the_cache),
        cmocka_unit_test(the_folder_follows_the_variables),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
