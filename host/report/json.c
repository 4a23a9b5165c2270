// Makes, reads and writes JSON. See json.h.
#include "report/json.h"

#include "base/plain_text.h"
#include "base/regular_file.h"

#include "image/output_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define JSON_FORMAT (JSON_INDENT(2) | JSON_REAL_PRECISION(9))

void glint_json_put(json_t *object, const char *key, json_t *value)
{
    // Both may be NULL if memory ran short; jansson accepts this and releases the value.
    (void)json_object_set_new(object, key, value);
}

void glint_json_put_flag(json_t *object, const char *key, bool value)
{
    glint_json_put(object, key, json_boolean(value));
}

void glint_json_put_count(json_t *object, const char *key, uint64_t value)
{
    glint_json_put(object, key, json_integer((json_int_t)value));
}

void glint_json_put_real(json_t *object, const char *key, double value)
{
    glint_json_put(object, key, isfinite(value) ? json_real(value) : json_null());
}

json_t *glint_json_text(const char *text)
{
    if (text == NULL) {
        return json_null();
    }
    json_t *value = json_string(text);
    if (value != NULL) {
        return value;
    }
    char *ascii = strdup(text);
    for (char *c = ascii; c != NULL && *c != '\0'; c++) {
        if ((unsigned char)*c >= 0x80) {
            *c = '?';
        }
    }
    value = ascii != NULL ? json_string(ascii) : NULL;
    free(ascii);
    return value;
}

void glint_json_put_text(json_t *object, const char *key, const char *text)
{
    glint_json_put(object, key, glint_json_text(text));
}

json_t *glint_json_warnings(const glint_warnings *warnings)
{
    json_t *list = json_array();
    for (size_t i = 0; i < warnings->count; i++) {
        (void)json_array_append_new(list, glint_json_text(warnings->texts[i]));
    }
    return list;
}

json_t *glint_json_at(const json_t *root, const char *path)
{
    json_t *value = NULL;
    for (const json_t *object = root; object != NULL && *path != '\0'; object = value) {
        char name[64];
        size_t length = strcspn(path, ".");
        snprintf(name, sizeof name, "%.*s", (int)length, path);
        value = json_object_get(object, name);
        path += length + (path[length] == '.' ? 1 : 0);
    }
    return value;
}

double glint_json_real_at(const json_t *root, const char *path)
{
    const json_t *value = glint_json_at(root, path);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

const char *glint_json_text_at(const json_t *root, const char *path)
{
    return json_string_value(glint_json_at(root, path));
}

glint_status glint_json_read(const char *path, json_t **root, glint_error *error)
{
    *root = NULL;
    FILE *file;
    TRY(glint_regular_file_open(path, &file, NULL, error));
    json_error_t cause;
    *root = json_loadf(file, JSON_REJECT_DUPLICATES, &cause);
    fclose(file);
    return *root != NULL ? GLINT_OK
                         : glint_fail(error, GLINT_BAD_INPUT, "%s: line %d: %s", path, cause.line,
                                      cause.text);
}

char *glint_json_dump(const json_t *value, size_t flags)
{
    char *text = json_dumps(value, flags);
    if (text != NULL && !glint_is_plain(text)) {
        free(text);
        text = json_dumps(value, flags | JSON_ENSURE_ASCII);
    }
    return text;
}

glint_status glint_json_print(json_t *root, char **text, glint_error *error)
{
    *text = NULL;
    char *body = root != NULL ? glint_json_dump(root, JSON_FORMAT) : NULL;
    json_decref(root);
    if (body == NULL) {
        return glint_fail_memory(error, "a report");
    }
    size_t length = strlen(body);
    *text = malloc(length + 2);
    if (*text == NULL) {
        free(body);
        return glint_fail_memory(error, "a report");
    }
    memcpy(*text, body, length);
    memcpy(*text + length, "\n", 2);
    free(body);
    return GLINT_OK;
}

glint_status glint_json_write(const char *path, json_t *root, glint_error *error)
{
    char *text = NULL;
    glint_status status;
    TRY_OR(cleanup, status, glint_json_print(root, &text, error));
    TRY_OR(cleanup, status, glint_output_file_write(path, text, strlen(text), error));
cleanup:
    free(text);
    return status;
}
