// Tests the base library: errors, warnings, allocation, vectors, whole reads and writes.
#include "base/memory.h"
#include "base/parallel.h"
#include "base/plain_text.h"
#include "base/regular_file.h"
#include "base/status.h"
#include "base/vector.h"
#include "base/whole_io.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static void an_error_is_one_line_whatever_it_quotes(void **state)
{
    (void)state;
    glint_error error = {0};
    assert_int_equal(glint_fail(&error, GLINT_BAD_INPUT, "%s: bad", "a\nb\x1b[31m"),
                     GLINT_BAD_INPUT);
    assert_string_equal(error.message, "a?b?[31m: bad");
    assert_int_equal(error.code, GLINT_BAD_INPUT);
    assert_int_equal(glint_fail(NULL, GLINT_USAGE, "nobody listens"), GLINT_USAGE);
}

static void a_long_message_is_cut_not_overrun(void **state)
{
    (void)state;
    char long_name[3 * GLINT_MESSAGE_CAPACITY];
    memset(long_name, 'x', sizeof long_name);
    long_name[sizeof long_name - 1] = '\0';
    glint_error error = {0};
    glint_fail(&error, GLINT_BAD_INPUT, "%s", long_name);
    assert_int_equal(strlen(error.message), GLINT_MESSAGE_CAPACITY - 1);
}

static void a_warning_is_said_once(void **state)
{
    (void)state;
    glint_warnings warnings = {0};
    for (int i = 0; i < 40; i++) {
        glint_warn(&warnings, "thing %d", i % 20);
    }
    assert_int_equal(warnings.count, 20);
    assert_string_equal(warnings.texts[19], "thing 19");
    glint_warn(NULL, "nobody listens");
    glint_warnings_free(&warnings);
    glint_warnings_free(&warnings); // zero is valid
}

static void allocation_is_zeroed_aligned_and_safe_from_overflow(void **state)
{
    (void)state;
    unsigned char *memory = glint_allocate(1000, 3);
    assert_non_null(memory);
    assert_int_equal((uintptr_t)memory % 64, 0);
    for (int i = 0; i < 3000; i++) {
        assert_int_equal(memory[i], 0);
    }
    free(memory);
    assert_null(glint_allocate(SIZE_MAX / 2, 3));
    assert_null(glint_allocate(SIZE_MAX, 1));
    void *nothing = glint_allocate(0, 8);
    assert_non_null(nothing);
    free(nothing);
    size_t product = 7;
    assert_false(glint_multiply(SIZE_MAX, 2, &product));
    assert_int_equal(product, 7);
}

static void large_memory_is_aligned_and_safe_from_overflow(void **state)
{
    (void)state;
    const size_t sizes[] = {0, 1, 4096, (size_t)5 << 20};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        unsigned char *memory = glint_allocate_unset(sizes[i], 1);
        assert_non_null(memory);
        assert_int_equal((uintptr_t)memory % 64, 0);
        memset(memory, 1, sizes[i]);
        free(memory);
    }
    assert_null(glint_allocate_unset(SIZE_MAX / 2, 3));
    assert_null(glint_allocate_unset(SIZE_MAX, 1));
}

static void add_one(size_t index, void *context)
{
    ((unsigned char *)context)[index]++;
}

static void work_is_done_once_by_any_number_of_threads(void **state)
{
    (void)state;
    static const size_t threads[] = {0, 1, 2, 7, 1000};
    for (size_t i = 0; i < sizeof threads / sizeof *threads; i++) {
        assert_in_range(glint_parallel_threads(threads[i]), 1, 64);
        for (size_t count = 0; count <= 300; count += 100) {
            unsigned char done[300] = {0};
            glint_parallel_for_on(threads[i], count, add_one, done);
            for (size_t k = 0; k < sizeof done; k++) {
                assert_int_equal(done[k], k < count);
            }
        }
    }
}

static void normalize_keeps_clear_of_overflow_and_says_when_it_cannot(void **state)
{
    (void)state;
    const double scales[] = {1e-300, 1e-160, 1, 1e160, 1e300};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        glint_vec3 n = glint_vec3_normalize((glint_vec3){3 * scales[i], 0, -4 * scales[i]});
        assert_true(fabs(n.x - 0.6) < 1e-15 && n.y == 0 && fabs(n.z + 0.8) < 1e-15);
    }
    const glint_vec3 hopeless[] = {{0, 0, 0}, {NAN, 1, 0}, {0, INFINITY, 0}, {0, 1, NAN}};
    for (size_t i = 0; i < sizeof hopeless / sizeof *hopeless; i++) {
        glint_vec3 n = glint_vec3_normalize(hopeless[i]);
        assert_true(n.x == 0 && n.y == 0 && n.z == 0);
    }
}

static void normals_stay_perpendicular_and_outside_under_any_matrix(void **state)
{
    (void)state;
    // Scale by (2, −3, 0.5) and shear. The matrix mirrors, so the winding of a triangle must be
    // swapped.
    const glint_mat4 m = {{{2, 1, 0, 7}, {0, -3, 0.25, 8}, {0, 0, 0.5, 9}, {0, 0, 0, 1}}};
    assert_true(glint_mat4_determinant3(&m) == -3);
    glint_vec3 a = {1, 2, 3}, b = {-1, 0.5, 2}, n = glint_vec3_cross(a, b);
    glint_vec3 none = {0, 0, 0}, origin = glint_mat4_point(&m, none);
    glint_vec3 ta = glint_vec3_subtract(glint_mat4_point(&m, a), origin);
    glint_vec3 tb = glint_vec3_subtract(glint_mat4_point(&m, b), origin);
    glint_vec3 tn = glint_mat4_normal(&m, n);
    assert_true(fabs(glint_vec3_dot(tn, ta)) < 1e-12);
    assert_true(fabs(glint_vec3_dot(tn, tb)) < 1e-12);
    // The outer side of the triangle with swapped winding.
    assert_true(glint_vec3_dot(tn, glint_vec3_cross(tb, ta)) > 0);
}

static void text_becomes_plain(void **state)
{
    (void)state;
    static const struct {
        const char *text, *plain;
    } cases[] = {
        {"", ""},
        {"gallery é 漢 \U0001f48e ~", "gallery é 漢 \U0001f48e ~"},
        {"a\x1b[31mb\a\b\t\n\r\x7f", "a?[31mb??????"},
        {"\xc2\x9b"
         "1m \xc2\x80 \xc2\x9f \u00a0",
         "?1m ? ? \u00a0"},
        // NOLINTNEXTLINE(misc-misleading-bidirectional): that is what it tests
        {"\u202etxt.exe\u2066 \u200f \u2028 \u061c", "?txt.exe? ? ? ?"},
        {"\xc2", "?"},                       // cut short
        {"\xe2\x80", "??"},                  // truncated
        {"\xc0\x9b \xe0\x80\x9b", "?? ???"}, // ESC in more bytes than it needs
        // A surrogate, and a code beyond the last valid code.
        {"\xed\xa0\x80 \xf4\x90\x80\x80 \xff", "? ???? ?"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[64];
        snprintf(text, sizeof text, "%s", cases[i].text);
        assert_int_equal(glint_is_plain(text), strcmp(cases[i].text, cases[i].plain) == 0);
        glint_make_plain(text);
        assert_string_equal(text, cases[i].plain);
        assert_true(glint_is_plain(text));
    }
    assert_true(glint_is_plain("two\nlines"));
}

static void a_list_of_names_is_cut_not_overrun(void **state)
{
    (void)state;
    char list[32] = "";
    glint_list_add(list, sizeof list, 0, "main");
    glint_list_add(list, sizeof list, 1, NULL);
    assert_string_equal(list, "0 \"main\", 1");
    glint_list_add(list, sizeof list, 2, "fourteen bytes");
    assert_string_equal(list, "0 \"main\", 1, ...");
    glint_list_add(list, sizeof list, 3, NULL);
    assert_string_equal(list, "0 \"main\", 1, ...");
    char filled[17] = "";
    for (int i = 0; i < 9; i++) {
        glint_list_add(filled, sizeof filled, i, NULL);
    }
    assert_string_equal(filled, "0, 1, 2, 3, ...");
}

static void pipes_are_not_waited_for(void **state)
{
    (void)state;
    char folder[] = "/tmp/glint-base-XXXXXX", pipe[64];
    FILE *file;
    glint_error error = {0};
    assert_non_null(mkdtemp(folder));
    snprintf(pipe, sizeof pipe, "%s/pipe", folder);
    assert_int_equal(mkfifo(pipe, 0600), 0);
    assert_int_equal(glint_regular_file_open(pipe, &file, NULL, &error), GLINT_BAD_INPUT);
    assert_null(file);
    assert_non_null(strstr(error.message, "no regular file"));
    assert_int_equal(glint_regular_file_open(folder, &file, NULL, &error), GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "is a folder"));
    unlink(pipe);
    rmdir(folder);
}

// A pipe takes and gives 64 KiB a call.
enum { SENT = 1 << 20 };

static void *send_bytes(void *context)
{
    const int pipe = *(int *)context;
    static unsigned char bytes[SENT];
    for (int i = 0; i < SENT; i++) {
        bytes[i] = (unsigned char)(i % 251);
    }
    const bool is_sent = glint_write_all(pipe, bytes, sizeof bytes);
    close(pipe);
    return is_sent ? NULL : context;
}

static void bytes_are_read_and_written_as_a_whole(void **state)
{
    (void)state;
    int ends[2];
    pthread_t sender;
    void *failed = NULL;
    static unsigned char bytes[SENT];
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(pthread_create(&sender, NULL, send_bytes, &ends[1]), 0);
    assert_true(glint_read_all(ends[0], bytes, sizeof bytes));
    for (int i = 0; i < SENT; i++) {
        assert_int_equal(bytes[i], i % 251);
    }
    assert_false(glint_read_all(ends[0], bytes, 1)); // the other end is closed
    assert_int_equal(errno, 0);
    pthread_join(sender, &failed);
    assert_null(failed);
    close(ends[0]);

    const int file = memfd_create("test", MFD_CLOEXEC);
    assert_true(glint_write_all_at(file, 2, "glint", 5));
    assert_true(glint_read_all_at(file, 3, bytes, 4));
    assert_memory_equal(bytes, "lint", 4);
    assert_false(glint_read_all_at(file, 3, bytes, 5));
    assert_int_equal(errno, 0);
    assert_true(glint_write_all(file, "", 0));
    close(file);
    const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
    assert_false(glint_write_all(full, "a", 1));
    assert_int_equal(errno, ENOSPC);
    close(full);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_error_is_one_line_whatever_it_quotes),
        cmocka_unit_test(a_long_message_is_cut_not_overrun),
        cmocka_unit_test(text_becomes_plain),
        cmocka_unit_test(a_list_of_names_is_cut_not_overrun),
        cmocka_unit_test(pipes_are_not_waited_for),
        cmocka_unit_test(bytes_are_read_and_written_as_a_whole),
        cmocka_unit_test(a_warning_is_said_once),
        cmocka_unit_test(allocation_is_zeroed_aligned_and_safe_from_overflow),
        cmocka_unit_test(large_memory_is_aligned_and_safe_from_overflow),
        cmocka_unit_test(work_is_done_once_by_any_number_of_threads),
        cmocka_unit_test(normalize_keeps_clear_of_overflow_and_says_when_it_cannot),
        cmocka_unit_test(normals_stay_perpendicular_and_outside_under_any_matrix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
