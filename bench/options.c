// Parses the options that all contests share. See options.h.
#include "options.h"

#include "series.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

glint_status bench_parse_size(const char *text, int *width, int *height, glint_error *error)
{
    char rest;
    if (sscanf(text, "%dx%d%c", width, height, &rest) != 2 || *width < 16 || *height < 16 ||
        *width > 16384 || *height > 16384 || *width % 16 != 0 || *height % 16 != 0) {
        return glint_fail(error, GLINT_USAGE, "--size: '%s' (multiples of 16, as 1920x1088)", text);
    }
    return GLINT_OK;
}

glint_status bench_parse_count(const char *name, const char *text, double most, double *value,
                               glint_error *error)
{
    char *end;
    *value = strtod(text, &end);
    if (end == text || *end != '\0' || !(*value >= 1 && *value <= most)) {
        return glint_fail(error, GLINT_USAGE, "--%s: '%s' (1 to %.0f)", name, text, most);
    }
    return GLINT_OK;
}

glint_status bench_set_text(char **copy, const char *text, glint_error *error)
{
    free(*copy);
    *copy = strdup(text);
    return *copy != NULL ? GLINT_OK : glint_fail_memory(error, "the options");
}

glint_status bench_take_option(int option, bench_request *request, glint_error *error)
{
    double count = 0;
    glint_status status;
    switch (option) {
    case BENCH_SCENES:
        return bench_set_text(&request->scenes, optarg, error);
    case BENCH_ROUNDS:
        status = bench_parse_count("rounds", optarg, BENCH_ROUNDS_MAX, &count, error);
        request->rounds = (int)count;
        return status;
    case BENCH_SIZE:
        return bench_parse_size(optarg, &request->width, &request->height, error);
    case BENCH_JSON:
        request->json = optarg;
        return GLINT_OK;
    case BENCH_HELP:
        request->help = true;
        return GLINT_OK;
    default:
        return glint_fail(error, GLINT_USAGE, "an option is unknown or lacks its value (--help)");
    }
}

glint_status bench_parse_options(int argc, char **argv, const bench_parser *parser,
                                 glint_error *error)
{
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, "", parser->options, NULL)) != -1) {
        TRY(parser->take(option, parser->request, error));
    }
    if (optind < argc) {
        return glint_fail(error, GLINT_USAGE, "unexpected argument '%s'", argv[optind]);
    }
    return GLINT_OK;
}

int bench_finish(const char *program, glint_status status, glint_error *error)
{
    if (status != GLINT_OK) {
        fprintf(stderr, "%s: %s\n%s", program, error->message,
                error->details != NULL ? error->details : "");
    }
    glint_error_free(error);
    return (int)status;
}
