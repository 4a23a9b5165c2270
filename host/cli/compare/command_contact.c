// Implements glint contact: puts many images on one sheet.
#include "cli/commands.h"
#include "cli/common/options.h"
#include "cli/common/say.h"

#include "base/memory.h"
#include "cli/common/file_names.h"
#include "cli/common/inputs.h"
#include "cli/common/tone_options.h"
#include "image/image_io.h"
#include "image/output_file.h"
#include "report/compare/contact_labels.h"
#include "report/compare/contact_sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// The options of glint contact.
typedef struct contact_request {
    const char *output;
    int columns; // 0: chosen automatically
    int width;   // pixels of each picture on the sheet
    double exposure;
    glint_tone tone;
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
    EXPOSURE_OPTION(offsetof(contact_request, exposure)),
    TONE_OPTION(offsetof(contact_request, tone)),
    GLINT_LARGE_IMAGES_OPTION,
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
    TRY(glint_image_check_output(request->output, NULL, error));
    return glint_output_file_check(request->output, error);
}

// Reads an image. Prints the error if it cannot be read, and lets the sheet go on.
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

// The sheet while it is being filled.
typedef struct contact_work {
    const contact_request *request;
    char *const *names;
    char (*labels)[GLINT_CONTACT_LABEL]; // of the names
    int count, missing;
    glint_contact_sheet sheet;
} contact_work;

static void put(contact_work *work, int index, const glint_image *image)
{
    glint_contact_sheet_put(&work->sheet, index, image, work->labels[index]);
}

// Makes the sheet with the aspect ratio of the first readable image. Marks the images before it as
// missing.
static glint_status begin_sheet(contact_work *work, const glint_image *first, int index,
                                glint_error *error)
{
    const int width = work->request->width;
    const double height = round((double)width * first->height / first->width);
    work->sheet = (glint_contact_sheet){.count = work->count,
                                        .columns = work->request->columns,
                                        .width = width,
                                        .height = (int)fmin(fmax(1, height), 65536)};
    TRY(glint_contact_sheet_begin(&work->sheet, error));
    for (int i = 0; i < index; i++) {
        put(work, i, NULL);
    }
    return GLINT_OK;
}

static glint_status add_image(contact_work *work, int index, glint_error *error)
{
    glint_image image = {0};
    glint_status status = GLINT_OK;
    if (!read_image(work->names[index], &image)) {
        work->missing++;
        if (work->sheet.image.pixels != NULL) {
            put(work, index, NULL);
        }
        return GLINT_OK;
    }
    if (work->sheet.image.pixels == NULL) {
        TRY_OR(cleanup, status, begin_sheet(work, &image, index, error));
    }
    put(work, index, &image);
cleanup:
    glint_image_free(&image);
    return status;
}

static glint_status make_labels(contact_work *work, glint_error *error)
{
    const size_t count = (size_t)work->count;
    work->labels = glint_allocate(count, sizeof *work->labels);
    return work->labels != NULL
               ? glint_contact_labels((const char *const *)work->names, count, work->labels, error)
               : glint_fail_memory(error, "the labels");
}

static glint_status make_sheet(contact_work *work, glint_error *error)
{
    const contact_request *request = work->request;
    const glint_write_options options = {.exposure = (float)request->exposure,
                                         .tone = request->tone};
    TRY(make_labels(work, error));
    for (int i = 0; i < work->count; i++) {
        TRY(add_image(work, i, error));
    }
    if (work->missing == work->count) {
        return glint_fail(error, GLINT_BAD_INPUT, "none of the images could be read");
    }
    TRY(glint_image_write(request->output, &work->sheet.image, &options, error));
    if (work->missing > 0) {
        return glint_fail(error, GLINT_FRAMES_FAILED, "%s: %d of %d images are missing on it",
                          request->output, work->missing, work->count);
    }
    return GLINT_OK;
}

static glint_status run(void *context, const glint_arguments *arguments, glint_error *error)
{
    contact_work work = {
        .request = context, .names = arguments->positionals, .count = arguments->positional_count};
    TRY(check_request(work.request, work.names, work.count, error));
    glint_warnings warnings = {0};
    tone_options_warn(work.request->output, work.request->exposure, work.request->tone, &warnings);
    glint_say_warnings(&warnings, 0);
    glint_warnings_free(&warnings);
    const glint_status status = make_sheet(&work, error);
    glint_contact_sheet_free(&work.sheet);
    free(work.labels);
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
    .description =
        "Reduces the images and puts them in rows, in the order of their names on the command "
        "line. Below each image stands its frame's number, or its name. Transparent "
        "images stand over grey. Pixels with NaN or infinity are magenta. An image that cannot be "
        "read becomes a crossed box, and the exit status is 6.",
    .examples = "  glint contact turn/*.exr -o sheet.png\n"
                "  glint contact turn/*.exr --columns 12 --width 160 --exposure 1 -o sheet.jpg\n",
    .groups = groups,
    .positional = "IMAGE",
    .takes_any_number = true,
    .request_size = sizeof(contact_request),
    .set_defaults = set_defaults,
    .run = run,
};
