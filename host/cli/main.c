// Runs the command that the command line names, prints errors and warnings, and sets the exit
// status.
#include "cli/commands.h"
#include "cli/common/options.h"

#include "cli/common/death.h"
#include "cli/common/file_names.h"
#include "cli/common/plain_stdout.h"
#include "cli/common/say.h"
#include "cli/common/signals.h"
#include "device/driver_cache.h"
#include "image/codec.h"
#include "image/formats.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

static const glint_command *const commands[] = {
    &glint_command_render,   &glint_command_farm,    &glint_command_contact, &glint_command_env,
    &glint_command_capture,  &glint_command_relight, &glint_command_compare, &glint_command_bench,
    &glint_command_selftest, &glint_command_info,    &glint_command_devices, &glint_command_warm};
enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

// Width for texts on stdout, [80, 100] columns: the terminal's width, or 80 without a terminal.
static int text_columns(void)
{
    struct winsize size;
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 80) {
        return 80;
    }
    return size.ws_col < 100 ? size.ws_col : 100;
}

static void print_overview(void)
{
    printf("glint " GLINT_VERSION ": renders mirrors and glass with OpenCL\n\n"
           "usage: glint COMMAND [options]\n\n"
           "Commands\n");
    for (int i = 0; i < COMMAND_COUNT; i++) {
        printf("  %-10s %s\n", commands[i]->name, commands[i]->summary);
    }
    printf("\nOptions\n"
           "  -h, --help   Print this; after a command, its options.\n"
           "  --version    Print the version.\n"
           "\n"
           "Exit status\n"
           "  0 done, 2 usage, 3 bad input, 4 no device or cluster, or it failed, 5 output could\n"
           "  not be written, 6 some frames of a sequence failed, 7 a comparison or a self-test\n"
           "  found an error, 8 not enough memory, 9 the device lacks memory or double precision,\n"
           "  130 or 143 stopped by a signal\n"
           "\n"
           "Examples\n"
           "  glint render scenes/gallery.gltf -o gallery.png\n"
           "  glint help render\n");
}

// Fails because no command has this name. A file is a scene, or pictures.
static glint_status fail_unknown(const char *name, const char *nearest, glint_error *error)
{
    const bool is_scene = glint_has_extension(name, ".gltf") || glint_has_extension(name, ".glb");
    struct stat facts;
    const bool is_there = stat(name, &facts) == 0 && S_ISREG(facts.st_mode);
    const bool is_file = is_scene || strchr(name, '/') != NULL || (is_there && nearest == NULL);
    if (is_file && glint_image_written_format(name) != NULL) {
        return glint_fail(error, GLINT_USAGE,
                          "%s is a picture, no command (did you mean glint compare %s OTHER, or "
                          "glint contact?)",
                          name, name);
    }
    if (is_file) {
        return glint_fail(error, GLINT_USAGE, "%s is %s (did you mean glint render %s -o OUT?)",
                          name, is_there ? "a file, no command" : "no command", name);
    }
    return nearest != NULL ? glint_fail(error, GLINT_USAGE,
                                        "unknown command '%s' (did you mean %s?)", name, nearest)
                           : glint_fail(error, GLINT_USAGE,
                                        "unknown command '%s' (glint --help lists them)", name);
}

static const glint_command *find_command(const char *name, glint_error *error)
{
    const char *names[COMMAND_COUNT + 2] = {"help"};
    for (int i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(commands[i]->name, name) == 0) {
            return commands[i];
        }
        names[i + 1] = commands[i]->name;
    }
    (void)fail_unknown(name, glint_nearest_word(name, names), error);
    return NULL;
}

static glint_status run_help(int argc, char **argv, glint_error *error)
{
    if (argc < 2 || argv[1][0] == '-') {
        print_overview();
        return GLINT_OK;
    }
    const glint_command *command = find_command(argv[1], error);
    if (command == NULL) {
        return GLINT_USAGE;
    }
    glint_options_help(command, text_columns(), stdout);
    return GLINT_OK;
}

// Runs the command. At the end, reports how the driver's cache was handled.
static glint_status run_and_tidy(const glint_command *command, void *request,
                                 const glint_arguments *arguments, glint_error *error)
{
    const glint_status status = command->run(request, arguments, error);
    const char *note = glint_driver_cache_note();
    if (note != NULL && status == GLINT_OK) {
        glint_say("warning: %s", note);
    }
    glint_driver_cache_release();
    glint_codec_abandon();
    return status;
}

static glint_status run_command(const glint_command *command, int argc, char **argv,
                                glint_error *error)
{
    glint_arguments arguments = {.words = argv, .word_count = argc};
    void *request = calloc(1, command->request_size);
    if (request == NULL) {
        return glint_fail_memory(error, "the options");
    }
    if (command->set_defaults != NULL) {
        command->set_defaults(request);
    }
    glint_status status = glint_options_parse(command, request, &arguments, error);
    if (status == GLINT_OK && arguments.help) {
        glint_options_help(command, text_columns(), stdout);
    } else if (status == GLINT_OK) {
        status = run_and_tidy(command, request, &arguments, error);
    }
    free(request);
    return status;
}

static glint_status dispatch(int argc, char **argv, glint_error *error)
{
    const char *word = argc > 1 ? argv[1] : "--help";
    if (strcmp(word, "--version") == 0) {
        printf("glint " GLINT_VERSION "\n");
        return GLINT_OK;
    }
    if (strcmp(word, "help") == 0 || strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0) {
        return run_help(argc - 1, argv + 1, error);
    }
    if (word[0] == '-') {
        return glint_fail(error, GLINT_USAGE,
                          "unknown option %s (options follow the command: glint render --help)",
                          word);
    }
    const glint_command *command = find_command(word, error);
    return command != NULL ? run_command(command, argc - 1, argv + 1, error) : GLINT_USAGE;
}

// Opens /dev/null for each closed standard stream. Otherwise the next opened file would take its
// number and receive its messages. A closed standard output becomes read-only, so that writing
// still fails.
static void open_standard_streams(void)
{
    int descriptor;
    do {
        descriptor = open("/dev/null", O_RDWR);
        if (descriptor == STDOUT_FILENO) {
            close(descriptor);
            descriptor = open("/dev/null", O_RDONLY);
        }
    } while (descriptor >= 0 && descriptor <= STDERR_FILENO);
    if (descriptor > STDERR_FILENO) {
        close(descriptor);
    }
}

int main(int argc, char **argv)
{
    open_standard_streams();
    glint_plain_stdout_begin();
    glint_signals_install();
    glint_death_install();
    glint_error error = {0};
    glint_status status = dispatch(argc, argv, &error);
    if (status == GLINT_OK) {
        status = glint_plain_stdout_end(&error);
    }
    if (status == GLINT_INTERRUPTED) {
        glint_error_free(&error);
        return glint_stop_status();
    }
    if (status != GLINT_OK) {
        glint_say_error(&error);
    }
    glint_error_free(&error);
    return (int)status;
}
