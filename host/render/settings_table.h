// Declares the table of settings: option, range and default of each setting, and its effects
// elsewhere. Options, help, checks, reports, fingerprints and baselines read it. See "Add a
// setting" in ARCHITECTURE.md.
#ifndef GLINT_RENDER_SETTINGS_TABLE_H
#define GLINT_RENDER_SETTINGS_TABLE_H

#include "base/option.h"
#include "render/settings.h"

// The heading of the help that lists the option.
typedef enum glint_settings_group {
    GLINT_SETTINGS_INTERNAL, // no heading: only the program sets it
    GLINT_SETTINGS_OF_ENVIRONMENT,
    GLINT_SETTINGS_OF_SIZE,
    GLINT_SETTINGS_OF_FRAME,
    GLINT_SETTINGS_OF_DEVICE,
    GLINT_SETTINGS_OF_LAYERS,
} glint_settings_group;

enum {
    GLINT_SETTING_VARIES = 1 << 0, // a renderer accepts another value: glint_renderer_set_settings
    GLINT_SETTING_WEIGHS_ERRORS = 1 << 1, // --max-error chooses its value
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

// The setting's role in the fingerprint. A number above 0 is its place among the numbers at the
// beginning. 0: it changes no pixels. BY_NAME: a setting that was added later. It is left out at
// its default, so that old fingerprints stay valid.
#define GLINT_FINGERPRINT_PLACES 18
#define GLINT_FINGERPRINT_BY_NAME (-1)

typedef struct glint_setting {
    glint_settings_group group;
    size_t offset, size; // of the member in glint_settings
    glint_setting_type type;
    unsigned roles;
    int fingerprint;
    // The key in reports; NULL: none. If an old report lacks the key, the default applies.
    const char *key;
    // The key in a file's metadata if the value is not the default; NULL: none.
    const char *metadata;
    // The reason why a capture needs the default; NULL: any value works.
    const char *no_capture;
    // The option, which also defines the range. For an internal setting: its name, if messages use
    // it, and the choices.
    glint_option option;
    // CUSTOM: prints the value as the option accepts it.
    void (*print)(const glint_settings *settings, char text[GLINT_SETTING_TEXT]);
} glint_setting;

extern const glint_setting glint_setting_table[];
extern const size_t glint_setting_count;

// Settings that exclude each other: at least one must have its default.
typedef struct glint_exclusion {
    size_t one, other; // offsets of the members
    const char *why;   // "--one: --other WHY"
} glint_exclusion;

extern const glint_exclusion glint_exclusion_table[];
extern const size_t glint_exclusion_count;

// Returns the row for the member at `offset` of glint_settings.
const glint_setting *glint_setting_at(size_t offset);

// Makes the option of row `index` of the group, for a request whose settings are at `offset`.
// Writes the default to `text`. Returns false if there is no such row.
bool glint_settings_option(glint_settings_group group, size_t index, size_t offset,
                           glint_option *option, char text[GLINT_SETTING_TEXT]);

// The offset of the option's destination for glint_option_parse. A custom parser gets all settings,
// because it may set several.
size_t glint_setting_destination(const glint_setting *setting);

// Element `i` of the member as a number, and the number of elements.
double glint_setting_number(const glint_setting *setting, const glint_settings *settings, size_t i);
size_t glint_setting_number_count(const glint_setting *setting);

// True if the setting differs between `a` and `b`.
bool glint_setting_differs(const glint_setting *setting, const glint_settings *a,
                           const glint_settings *b);

// The first setting with one of the roles whose value is not the default; NULL: none.
const glint_setting *glint_settings_find_changed(const glint_settings *settings, unsigned roles);

// Prints the value as the option accepts it: "auto", "0.3", "vertex-color".
void glint_setting_print(const glint_setting *setting, const glint_settings *settings,
                         char text[GLINT_SETTING_TEXT]);

// Prints the name for messages: "--mend", "--filter mip".
void glint_setting_print_name(const glint_setting *setting, const glint_settings *settings,
                              char text[GLINT_SETTING_TEXT]);

#endif
