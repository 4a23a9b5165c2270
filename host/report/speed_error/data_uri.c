// Encodes pictures as data URIs. See data_uri.h.
#include "report/speed_error/data_uri.h"

#include "base/memory.h"
#include "image/image_io.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Encodes `count` bytes, 1 to 3, as four characters of base64 (RFC 4648).
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

glint_status glint_data_uri_make(const glint_image *image, glint_data_format format, char **uri,
                                 glint_error *error)
{
    const bool is_png = format == GLINT_DATA_PNG;
    const glint_write_options options = {.compression = is_png ? "9" : "90"};
    glint_encoded file;
    *uri = NULL;
    TRY(glint_image_encode(is_png ? "picture.png" : "picture.jpeg", image, &options, &file, error));
    *uri = make_uri(file.bytes, file.size, is_png ? "png" : "jpeg");
    free(file.bytes);
    return *uri != NULL ? GLINT_OK : glint_fail_memory(error, "a picture of the page");
}
