// Pictures as data URIs. See data_uri.h.
#include "report/speed_error/data_uri.h"

#include "base/memory.h"
#include "image/image_io.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Writes the characters of three bytes, of which `count` are there (RFC 4648).
static void encode(const uint8_t *bytes, size_t count, char text[4])
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    uint32_t bits = (uint32_t)bytes[0] << 16;
    bits |= count > 1 ? (uint32_t)bytes[1] << 8 : 0;
    bits |= count > 2 ? bytes[2] : 0;
    for (size_t i = 0; i < 4; i++) {
        text[i] = i <= count ? digits[bits >> (18 - 6 * i) & 63] : '=';
    }
}

static char *make_uri(const uint8_t *bytes, size_t count, const char *type)
{
    const size_t begins = strlen("data:image/;base64,") + strlen(type);
    char *uri = glint_allocate_unset(begins + (count + 2) / 3 * 4 + 1, 1);
    if (uri == NULL) {
        return NULL;
    }
    char *text = uri + snprintf(uri, begins + 1, "data:image/%s;base64,", type);
    for (size_t i = 0; i < count; i += 3, text += 4) {
        encode(bytes + i, count - i < 3 ? count - i : 3, text);
    }
    *text = '\0';
    return uri;
}

static glint_status read_uri(const char *path, const char *type, char **uri, glint_error *error)
{
    FILE *file = fopen(path, "rb");
    long size = -1;
    if (file != NULL && fseek(file, 0, SEEK_END) == 0) {
        size = ftell(file);
        rewind(file);
    }
    uint8_t *bytes = size > 0 ? glint_allocate_unset((size_t)size, 1) : NULL;
    const bool is_read = bytes != NULL && fread(bytes, 1, (size_t)size, file) == (size_t)size;
    if (file != NULL) {
        fclose(file);
    }
    *uri = is_read ? make_uri(bytes, (size_t)size, type) : NULL;
    free(bytes);
    return *uri != NULL ? GLINT_OK
                        : glint_fail(error, GLINT_OUTPUT_FAILED,
                                     "%s: a picture cannot be read back (is there memory?)", path);
}

glint_status glint_data_uri_make(const glint_image *image, glint_data_format format, char **uri,
                                 glint_error *error)
{
    const char *type = format == GLINT_DATA_PNG ? "png" : "jpeg";
    const char *base = getenv("TMPDIR");
    char folder[4000], path[4096];
    *uri = NULL;
    const int length = snprintf(folder, sizeof folder, "%s/glint-page-XXXXXX",
                                base != NULL && base[0] != '\0' ? base : "/tmp");
    if (length >= (int)sizeof folder || mkdtemp(folder) == NULL) {
        return glint_fail(error, GLINT_OUTPUT_FAILED,
                          "%s: no folder for a picture (%s; TMPDIR names another place)",
                          base != NULL ? base : "/tmp", strerror(errno));
    }
    snprintf(path, sizeof path, "%s/picture.%s", folder, type);
    const glint_write_options options = {.compression = format == GLINT_DATA_PNG ? "9" : "90"};
    glint_status status = glint_image_write(path, image, &options, error);
    if (status == GLINT_OK) {
        status = read_uri(path, type, uri, error);
    }
    unlink(path);
    rmdir(folder);
    return status;
}
