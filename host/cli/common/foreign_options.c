// Lists the options of other renderers. See foreign_options.h.
#include "cli/common/foreign_options.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

// Stand for the positional arguments, in place of an option's name.
#define INPUT "<input>"
#define OUTPUT "<output>"

const glint_foreign_option glint_foreign_options[] = {
    // The image.
    {"resolution res width height w xres yres image-size image-width image-height render-size "
     "dimensions geometry",
     "size", NULL},
    {"size resolution res w image-width thumbnail thumbnail-size thumb", "width", NULL},
    {"cols column per-row grid tile", "columns", NULL},
    {"spp sample-count num-samples nsamples samples-per-pixel pixel-samples aa aa-samples "
     "antialias "
     "antialiasing anti-aliasing supersample supersampling msaa subsamples",
     "samples", "16"},
    {"samples spp", "rays", NULL},
    {"bounces max-bounces maxbounces max-depth maxdepth ray-depth max-ray-depth trace-depth "
     "recursion recursion-depth path-length",
     "depth", NULL},
    {"bg bgcolor bg-color background-color backdrop backplate", "background", NULL},
    {"transparent transparency film-transparent alpha no-background rgba", "background",
     "transparent"},
    {"crop crop-window region render-region border roi window", NULL, "glint renders whole frames"},
    {"tile tiles tile-size tilesize bucket bucket-size", NULL, "glint chooses its tiles itself"},
    // Files.
    {"output out outfile out-file output-file output-path o save write", "output", NULL},
    {"output out outfile out-file output-file output-path o save write", OUTPUT, NULL},
    {"output out outfile out-file output-file output-path o save write", "json", NULL},
    {"input in infile input-file i scene-file model gltf glb file", INPUT, NULL},
    {"format type ext extension file-format filetype image-format render-format", NULL,
     "the extension of the output's name is the format"},
    {"quality jpeg-quality jpg-quality codec", "compression", NULL},
    {"bit-depth bitdepth color-depth colour-depth pixel-type datatype half", "exr-type", NULL},
    {"passes pass layers render-passes aovs cryptomatte normals normal zdepth z-depth depth-pass "
     "depth-map depthmap albedo channels",
     "aov", NULL},
    {"overwrite force clobber y yes", NULL, "glint replaces existing files without being told"},
    {"resume continue no-overwrite skip", "skip-existing", NULL},
    {"report statistics timing timings profile", "stats", NULL},
    {"report statistics timing timings profile", "json", NULL},
    {"quiet silent q no-progress", "progress", "none"},
    {"verbose verbosity v log log-level loglevel debug", "progress", "plain"},
    {"display gui interactive viewer live", NULL, "glint opens no window"},
    {"config conf config-file", NULL, "glint reads no file of settings"},
    {"cache cache-dir no-cache", NULL,
     "POCL_CACHE_DIR and GLINT_CACHE_DIR name the folders of the caches"},
    {"version", NULL, "glint --version prints it"},
    // The camera.
    {"cam view camera-name camera-index active-camera", "camera", NULL},
    {"field-of-view fovy yfov vfov fovx xfov hfov camera-fov angle angle-of-view focal "
     "focal-length "
     "focallength lens zoom",
     "fov", NULL},
    {"position from origin camera-position camera-pos cam-pos eye-position lookfrom look-from "
     "camera-origin viewpoint",
     "eye", NULL},
    {"position from origin camera-position viewpoint", "at", NULL},
    {"target lookat lookto look-to camera-target interest", "look-at", NULL},
    {"autofit auto-fit frame-all auto-frame fit-view zoom-extents zoom-to-fit", "fit", NULL},
    {"orbit spin turn-table revolve rotate-camera", "turntable", NULL},
    {"dof depth-of-field aperture fstop f-stop f-number bokeh blades focus focus-distance "
     "focal-distance focaldistance lens-radius lens-size defocus",
     NULL, "glint has no depth of field"},
    {"motion-blur motionblur mblur shutter shutter-speed shutter-open shutter-close", NULL,
     "glint has no motion blur"},
    // Sequences.
    {"frame f frame-range framerange range frame-list start end start-frame end-frame frame-start "
     "frame-end first-frame last-frame",
     "frames", NULL},
    {"frames iterations repeat repeats runs loops", "rounds", NULL},
    {"framerate frame-rate frames-per-second", "fps", NULL},
    {"clip anim action take", "animation", NULL},
    {"chunk chunks part slice worker distribute", "shard", NULL},
    // The scene and its light.
    {"environment envmap env-map environment-map envlight hdri hdr ibl skybox sky skydome dome "
     "world light-probe background-image background-hdr",
     "env", NULL},
    {"env-rotation rotate-env environment-rotation envmap-rotation hdri-rotation sky-rotation "
     "world-rotation env-angle rotation",
     "env-rotate", NULL},
    {"env-intensity env-strength environment-intensity ibl-intensity hdri-strength world-strength",
     NULL, "glint has no strength of the environment alone"},
    {"no-lights disable-lights", "lights", "none"},
    {"override-material material-override default-material override mat clay", "material", NULL},
    {"hide exclude ignore remove", "without", NULL},
    {"object objects node nodes isolate include", "only", NULL},
    {"texture-limit max-texture-size max-texture texture-resolution texture-res", "texture-size",
     NULL},
    {"gi global-illumination indirect ao ambient-occlusion caustics photons photon-map", NULL,
     "the environment and the file's lights alone light paint"},
    {"fog haze volumetrics subsurface sss", NULL, "glint has neither fog nor scattering in solids"},
    {"integrator engine renderer render-engine path-tracing", NULL, "glint has one way to render"},
    // Tone.
    {"ev stops brightness gain exposure-compensation", "exposure", NULL},
    {"tonemap tone-map tonemapper tone-mapper tonemapping tone-mapping view-transform filmic aces "
     "agx look",
     "tone", NULL},
    {"gamma srgb colorspace color-space colourspace ocio lut", NULL,
     "EXR and HDR are linear, and other formats have the sRGB curve"},
    // Noise.
    {"noise-threshold error-threshold target-error adaptive adaptive-sampling", "max-error", NULL},
    {"noise-threshold error-threshold target-error adaptive adaptive-sampling", NULL,
     "glint has no adaptive sampling"},
    {"denoise denoiser oidn noise noise-level", NULL, "glint's pictures have no noise to remove"},
    {"seed random-seed rng-seed", NULL, "glint draws no random numbers"},
    {"clamp clamp-direct clamp-indirect firefly fireflies max-radiance", NULL,
     "glint clamps no light"},
    // The machine.
    {"gpu use-gpu cuda optix hip", "device", "gpu"},
    {"cpu use-cpu", "device", "cpu"},
    {"platform opencl cl-device device-id device-index gpu-id", "device", NULL},
    {"threads nthreads num-threads cores ncpus", "cpus", NULL},
    {"threads nthreads num-threads workers j", "jobs", NULL},
    {"threads t nthreads num-threads numthreads thread-count cores ncpus cpus workers jobs j", NULL,
     "glint takes the cores that it may use: taskset limits them"},
    {"double double-precision fp64 float64", "precision", "double"},
    {"time-limit timelimit max-time", NULL, "glint has no limit of time"},
    {NULL, NULL, NULL},
};

// True if `name` is one of the names. Letters' case does not matter, and '_' is a dash.
static bool is_among(const char *name, const char *names)
{
    while (*names != '\0') {
        size_t length = 0;
        bool is_it = true;
        for (; names[length] != '\0' && names[length] != ' '; length++) {
            const char typed = is_it ? name[length] : '\0';
            is_it = is_it && (typed == '_' ? '-' : tolower((unsigned char)typed)) == names[length];
        }
        if (is_it && name[length] == '\0') {
            return true;
        }
        names += length + (names[length] == ' ' ? 1 : 0);
    }
    return false;
}

// True if the command takes -o, or, like farm, the arguments of a command that does.
static bool takes_output(const glint_command *command)
{
    return strstr(command->synopsis, "-o ") != NULL;
}

// The positional argument of the command that a row stands for; NULL if there is none.
static const char *positional_of(const glint_foreign_option *row, const glint_command *command)
{
    const bool is_output = strcmp(row->ours, OUTPUT) == 0;
    const char *what = is_output ? "OUT" : command->positional;
    const bool is_named = what != NULL && strstr(command->synopsis, what) != NULL;
    return is_named && !(is_output && takes_output(command)) ? what : NULL;
}

// Writes what a row says to the user of this command. False if the command lacks the row's option.
static bool explain(const glint_foreign_option *row, const glint_command *command, char *text,
                    size_t capacity)
{
    if (row->ours == NULL) {
        snprintf(text, capacity, "%s", row->text);
        return true;
    }
    if (row->ours[0] == '<') {
        const char *what = positional_of(row, command);
        if (what != NULL) {
            snprintf(text, capacity, "%s stands without an option: glint %s %s", what,
                     command->name, command->synopsis);
        }
        return what != NULL;
    }
    glint_option option;
    const bool is_for_results = strcmp(row->ours, "json") == 0;
    if (!glint_options_find(command, row->ours, &option) ||
        (is_for_results && takes_output(command))) {
        return false;
    }
    const char *value = row->text != NULL ? row->text : option.argument;
    snprintf(text, capacity, "did you mean --%s%s%s?", option.name, value != NULL ? " " : "",
             value != NULL ? value : "");
    return true;
}

bool glint_foreign_option_explain(const glint_command *command, const char *name, char *text,
                                  size_t capacity)
{
    for (const glint_foreign_option *row = glint_foreign_options; row->names != NULL; row++) {
        if (is_among(name, row->names) && explain(row, command, text, capacity)) {
            return true;
        }
    }
    return false;
}
