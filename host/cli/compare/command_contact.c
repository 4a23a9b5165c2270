// glint contact: many images on one sheet.
#include "cli/commands.h"
#include "cli/common/options.h"
#include "cli/common/say.h"

#include "cli/common/file_names.h"
#include "image/image_io.h"
#include "image/output_file.h"
#include "report/compare/contact_sheet.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct contact_request {
    const char *output;
    int columns; // 0: by itself
    int width;   // of a picture on the sheet
    double exposure;
} contact_request;

static const glint_option contact_options[] = {
    {GLINT_OPTION_HEADING, .help = "The sheet"},
    {GLINT_OPTION_TEXT, .letter = 'o', .name = "output", .argument = "SHEET",
     .help = "The image to write, by its extension: png, jpg, tiff, exr or hdr.",
     .offset = offsetof(contact_request, output)},
    {GLINT_OPTION_INT, .name = "columns", .argument = "N", .help = "Images in a row.",
     .fallback = "as many as rows, about", .offset = offsetof(contact_request, columns),
     .minimum = 1, .maximum = 1000},
    {GLINT_OPTION_INT, .name = "width", .argument = "PIXELS",
     .help = "Width of each image on the sheet; the height is the first one's share.",
     .fallback = "240", .offset = offsetof(contact_request, width), .minimum = 16, .maximum = 4096},
    {GLINT_OPTION_REAL, .name = "exposure", .argument = "EV",
     .help = "Stops of exposure for PNG, JPEG and TIFF; EXR and HDR stay linear.", .fallback = "0",
     .offset = offsetof(contact_request, exposure), .minimum = -100, .maximum = 100},
    GLINT_OPTION_END,
};

static const glint_option *const groups[] = {contact_options, NULL};

static glint_status check_request(const contact_request *request, char *const *names, int count,
                                  glint_error *error)
{
    if (request->output == NULL) {
        return glint_fail(error, GLINT_USAGE, "no output (name one: -o sheet.png)");
    }
    if (count == 0) {
        return glint_fail(error, GLINT_USAGE,
                          "no images (name some: glint contact out/*.exr -o %s)", request->output);
    }
    for (int i = 0; i < count; i++) {
        if (glint_same_file(request->output, names[i])) {
            return glint_fail(error, GLINT_USAGE,
                              "--output %s: this is one of the images (name another file)",
                              request->output);
        }
    }
    glint_status status = glint_image_check_output(request->output, NULL, error);
    return status == GLINT_OK ? glint_output_file_check(request->output, error) : status;
}

// What stands below an image: the last number in its file's name, which is a frame's; else where it
// comes on the sheet.
static void label_of(const char *path, int index, char *label, size_t capacity)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash != NULL ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    const char *end = dot != NULL ? dot : name + strlen(name);
    while (end > name && !isdigit((unsigned char)end[-1])) {
        end--;
    }
    const char *begin = end;
    while (begin > name && isdigit((unsigned char)begin[-1])) {
        begin--;
    }
    if (begin < end) {
        snprintf(label, capacity, "%.*s", (int)(end - begin), begin);
    } else {
        snprintf(label, capacity, "%d", index + 1);
    }
}

// Reads an image; one that cannot be read is said, and no error of the sheet.
static bool read_image(const char *path, glint_image *image)
{
    glint_error error = {0};
    const bool is_read = glint_image_read(path, image, NULL, &error) == GLINT_OK;
    if (!is_read) {
        glint_say_error(&error);
    }
    glint_error_free(&error);
    return is_read;
}

// The shape of the first image that can be read is that of all places.
static glint_status begin_sheet(const contact_request *request, const glint_image *first, int count,
                                glint_contact_sheet *sheet, glint_error *error)
{
    const double height = (double)request->width * first->height / first->width;
    const int rounded = (int)fmin(fmax(1, round(height)), 65536);
    return glint_contact_sheet_create(count, request->columns, request->width, rounded, sheet,
                                      error);
}

static glint_status fill_sheet(const contact_request *request, char *const *names, int count,
                               glint_contact_sheet *sheet, int *missing, glint_error *error)
{
    glint_status status = GLINT_OK;
    int waiting = 0; // images before the first that could be read
    for (int i = 0; status == GLINT_OK && i < count; i++) {
        glint_image image = {0};
        const bool is_read = read_image(names[i], &image);
        *missing += !is_read;
        if (is_read && sheet->columns == 0) {
            status = begin_sheet(request, &image, count, sheet, error);
        } else if (sheet->columns == 0) {
            waiting++;
        }
        for (; status == GLINT_OK && sheet->columns > 0 && waiting > 0; waiting--) {
            char label[64];
            label_of(names[i - waiting], i - waiting, label, sizeof label);
            glint_contact_sheet_put(sheet, i - waiting, NULL, label);
        }
        if (status == GLINT_OK && sheet->columns > 0) {
            char label[64];
            label_of(names[i], i, label, sizeof label);
            glint_contact_sheet_put(sheet, i, is_read ? &image : NULL, label);
        }
        glint_image_free(&image);
    }
    return status;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    const contact_request *request = context;
    const int count = arguments->positional_count;
    glint_status status = check_request(request, arguments->positionals, count, error);
    if (status != GLINT_OK) {
        return status;
    }
    glint_contact_sheet sheet = {0};
    int missing = 0;
    status = fill_sheet(request, arguments->positionals, count, &sheet, &missing, error);
    if (status == GLINT_OK && missing == count) {
        status = glint_fail(error, GLINT_BAD_INPUT, "none of the images could be read");
    }
    if (status == GLINT_OK) {
        const glint_write_options options = {.exposure = (float)request->exposure};
        status = glint_image_write(request->output, &sheet.image, &options, error);
    }
    glint_contact_sheet_free(&sheet);
    if (status == GLINT_OK && missing > 0) {
        status = glint_fail(error, GLINT_FRAMES_FAILED, "%s: %d of %d images are missing on it",
                            request->output, missing, count);
    }
    return status;
}

static void set_defaults(void *request)
{
    ((contact_request *)request)->width = 240;
}

const glint_command glint_command_contact = {
    .name = "contact",
    .summary = "show many images on one sheet",
    .synopsis = "IMAGE… -o SHEET [options]",
    .description = "Makes each image small and puts them in rows, in the order in which they are "
                   "named, with the last number in their name below. Transparent ones stand over "
                   "grey; a pixel with NaN or infinity in it is magenta; an image that cannot be "
                   "read is a crossed box, and gives exit status 6.",
    .examples = "  glint contact turn/*.exr -o sheet.png\n"
                "  glint contact turn/*.exr --columns 12 --width 160 --exposure 1 -o sheet.jpg\n",
    .groups = groups,
    .positional = "IMAGE",
    .takes_any_number = true,
    .request_size = sizeof(contact_request),
    .set_defaults = set_defaults,
    .run = run,
};
