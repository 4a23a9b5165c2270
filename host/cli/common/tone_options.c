// Warns of --exposure and --tone where they have no effect. See tone_options.h.
#include "cli/common/tone_options.h"

#include "image/image_io.h"

void tone_options_warn(const char *path, double exposure, glint_tone tone, glint_warnings *warnings)
{
    if (!glint_image_stays_linear(path)) {
        return;
    }
    if (exposure != 0) {
        glint_warn(warnings, "%s: --exposure is left out, this format stays linear", path);
    }
    if (tone != GLINT_TONE_NONE) {
        glint_warn(warnings, "%s: --tone is left out, this format stays linear (write .png)", path);
    }
}
