// The table of settings: for each its option, range and default, and what depends on it. Options,
// help, checks, reports, fingerprints and baselines read it. See "Add a setting" in
// ARCHITECTURE.md.
#ifndef GLINT_RENDER_SETTINGS_TABLE_H
#define GLINT_RENDER_SETTINGS_TABLE_H

#include "base/option.h"
#include "render/settings.h"

// Under which heading of the help the option stands.
typedef enum glint_settings_group {
    GLINT_SETTINGS_INTERNAL, // nowhere: the program sets it
    GLINT_SETTINGS_OF_ENVIRONMENT,
    GLINT_SETTINGS_OF_SIZE,
    GLINT_SETTINGS_OF_FRAME,
    GLINT_SETTINGS_OF_DEVICE,
    GLINT_SETTINGS_OF_LAYERS,
} glint_settings_group;

enum {
    GLINT_SETTING_VARIES = 1 << 0, // a renderer takes another value: glint_renderer_set_settings
    GLINT_SETTING_WEIGHS_ERRORS = 1 << 1, // --max-error decides about it
    GLINT_SETTING_IS_COMPARED = 1 << 2,   // bench --error tries its values
};

// The C type of a member, or of its elements.
typedef enum glint_setting_type {
    GLINT_SETTING_BOOL,
    GLINT_SETTING_INT,
    GLINT_SETTING_UNSIGNED, // enums, too
    GLINT_SETTING_REAL,
} glint_setting_type;

#define GLINT_SETTING_TEXT 128 // bytes of a value as text

// In the fingerprint: a place among the numbers that it has always begun with, 0 for a setting that
// decides no pixels, or BY_NAME for a setting that came later. The last say nothing while they are
// at their defaults, so that fingerprints from before stay valid.
#define GLINT_FINGERPRINT_PLACES 18
#define GLINT_FINGERPRINT_BY_NAME (-1)

typedef struct glint_setting {
    glint_settings_group group;
    size_t offset, size; // of the member in glint_settings
    glint_setting_type type;
    unsigned roles;
    int fingerprint;
    const char *key;        // in reports; NULL: not there. A report that lacks it is older than the
                            // setting, and means the default
    const char *metadata;   // in a file where it is not at its default; NULL: nowhere
    const char *no_capture; // why a capture takes its default alone; NULL: any value
    glint_option option;    // what the command line takes, and so the range. Of an internal setting
                            // the name, where messages have one, and the choices
    // CUSTOM: writes what the option takes for the value.
    void (*print)(const glint_settings *settings, char text[GLINT_SETTING_TEXT]);
} glint_setting;

extern const glint_setting glint_setting_table[];
extern const size_t glint_setting_count;

// Settings that do not go together: not both can be other than their defaults.
typedef struct glint_exclusion {
    size_t one, other; // offsets of the members
    const char *why;   // "--one: --other WHY"
} glint_exclusion;

extern const glint_exclusion glint_exclusion_table[];
extern const size_t glint_exclusion_count;

// The row of the member at that offset of glint_settings.
const glint_setting *glint_setting_at(size_t offset);

// The option of the group's row `index`, for a request with its settings at `offset`; false where
// there is none. Its default is written into `text`.
bool glint_settings_option(glint_settings_group group, size_t index, size_t offset,
                           glint_option *option, char text[GLINT_SETTING_TEXT]);

// Where the option writes the value, as glint_option_parse takes it: a parser of its own gets all
// settings, as it may set several.
size_t glint_setting_destination(const glint_setting *setting);

// Element `i` of the member as a number.
double glint_setting_number(const glint_setting *setting, const glint_settings *settings, size_t i);
size_t glint_setting_number_count(const glint_setting *setting);

// Whether two differ in this.
bool glint_setting_differs(const glint_setting *setting, const glint_settings *a,
                           const glint_settings *b);

// The first that is not at its default of those with one of the roles; NULL: none.
const glint_setting *glint_settings_find_changed(const glint_settings *settings, unsigned roles);

// The value as the option takes it: "auto", "0.3", "vertex-color".
void glint_setting_print(const glint_setting *setting, const glint_settings *settings,
                         char text[GLINT_SETTING_TEXT]);

// As messages name it: "--mend", "--filter mip".
void glint_setting_print_name(const glint_setting *setting, const glint_settings *settings,
                              char text[GLINT_SETTING_TEXT]);

#endif
