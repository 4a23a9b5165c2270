// Writes glTF files for tests. See gltf_text.h.
#include "support/gltf_text.h"
#include "support/by_corner.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

const tetrahedron the_tetrahedron = {
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {{-0.57735026f, -0.57735026f, -0.57735026f}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3},
};

const char *folder_path(const char *folder, const char *name)
{
    static char path[8192];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_file(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

// Keeps a copy of every file under a unique name, as a seed of the fuzzer.
static void keep_copy(const char *name, const void *bytes, size_t size)
{
    static int count;
    const char *kept = getenv("GLINT_TESTS_KEEP");
    char path[8192];
    if (kept != NULL) {
        const char *slash = strrchr(name, '/');
        snprintf(path, sizeof path, "%s.%d.%s", kept, count++, slash != NULL ? slash + 1 : name);
        write_file(path, bytes, size);
    }
}

const char *write_bytes(const char *folder, const char *name, const void *bytes, size_t size)
{
    const char *path = folder_path(folder, name);
    write_file(path, bytes, size);
    keep_copy(name, bytes, size);
    return path;
}

// `text` needs 4 characters for every 3 bytes, and a terminator.
static void write_base64(const unsigned char *bytes, size_t size, char *text)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        uint32_t bits = (uint32_t)bytes[i] << 16;
        bits |= i + 1 < size ? (uint32_t)bytes[i + 1] << 8 : 0;
        bits |= i + 2 < size ? bytes[i + 2] : 0;
        for (int k = 0; k < 4; k++) {
            bool padding = i + (size_t)k > size;
            *text++ = padding ? '=' : digits[bits >> (18 - 6 * k) & 63];
        }
    }
    *text = '\0';
}

char *gltf_text(const void *bytes, size_t size, const char *rest)
{
    char *base64 = malloc(size / 3 * 4 + 8);
    size_t capacity = size / 3 * 4 + strlen(rest) + 256;
    char *text = malloc(capacity);
    assert_non_null(base64);
    assert_non_null(text);
    write_base64(bytes, size, base64);
    snprintf(text, capacity,
             "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%zu,"
             "\"uri\":\"data:application/octet-stream;base64,%s\"}],%s}",
             size, base64, rest);
    free(base64);
    return text;
}

static void put32(unsigned char *bytes, size_t value)
{
    for (int i = 0; i < 4; i++) {
        bytes[i] = (unsigned char)(value >> (8 * i));
    }
}

// Writes four letters without a terminator.
static void put_tag(unsigned char *bytes, const char *tag)
{
    for (int i = 0; i < 4; i++) {
        bytes[i] = (unsigned char)tag[i];
    }
}

unsigned char *glb_bytes(const void *bytes, size_t size, const char *rest, size_t *glb_size)
{
    size_t capacity = strlen(rest) + 256;
    char *json = malloc(capacity);
    assert_non_null(json);
    int length = snprintf(json, capacity,
                          "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%zu}],%s}",
                          size, rest);
    size_t json_size = ((size_t)length + 3) / 4 * 4;
    size_t bin_size = (size + 3) / 4 * 4;
    *glb_size = 12 + 8 + json_size + 8 + bin_size;
    unsigned char *glb = calloc(*glb_size, 1);
    assert_non_null(glb);
    put_tag(glb, "glTF");
    put32(glb + 4, 2);
    put32(glb + 8, *glb_size);
    put32(glb + 12, json_size);
    put_tag(glb + 16, "JSON");
    memset(glb + 20, ' ', json_size);
    memcpy(glb + 20, json, (size_t)length);
    put32(glb + 20 + json_size, bin_size);
    put_tag(glb + 24 + json_size, "BIN"); // with a zero at the end
    memcpy(glb + 28 + json_size, bytes, size);
    free(json);
    return glb;
}

glint_status load_text(const char *folder, const char *text, glint_scene *scene,
                       glint_warnings *warnings, glint_error *error)
{
    const char *path = write_bytes(folder, "test.gltf", text, strlen(text));
    return glint_scene_load(path, NULL, scene, warnings, error);
}

glint_scene load_rest(const char *folder, const void *bytes, size_t size, const char *rest)
{
    char *text = gltf_text(bytes, size, rest);
    glint_scene scene;
    glint_error error = {0};
    if (load_text(folder, text, &scene, NULL, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    free(text);
    return scene;
}

glint_scene load_tetrahedron(const char *folder, const char *rest)
{
    char joined[4096];
    snprintf(joined, sizeof joined, TETRAHEDRON ",%s", rest);
    return load_rest(folder, &the_tetrahedron, sizeof the_tetrahedron, joined);
}

glint_scene load_by_corner(const char *folder, const void *bytes, size_t size, const char *rest)
{
    glint_scene scene = load_rest(folder, bytes, size, rest);
    scene_by_corner(&scene);
    return scene;
}

bool any_warning_has(const glint_warnings *warnings, const char *part)
{
    for (size_t i = 0; i < warnings->count; i++) {
        if (strstr(warnings->texts[i], part) != NULL) {
            return true;
        }
    }
    return false;
}

void assert_refused(const char *path, const char *said)
{
    glint_scene scene;
    glint_warnings warnings = {0};
    glint_error error = {0};
    glint_status status = glint_scene_load(path, NULL, &scene, &warnings, &error);
    if (status != GLINT_BAD_INPUT || strstr(error.message, said) == NULL) {
        fail_msg("said \"%s\" (%d), expected \"%s\"", error.message, (int)status, said);
    }
    assert_memory_equal(error.message, path, strlen(path));
    assert_int_equal(warnings.count, 0);
    assert_null(scene.positions);
    glint_error_free(&error);
    glint_warnings_free(&warnings);
}

void assert_rest_refused(const char *folder, const char *rest, const char *said)
{
    char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, rest);
    assert_refused(write_bytes(folder, "bad.gltf", text, strlen(text)), said);
    free(text);
}
