// Prints the benchmark's table. See bench_table.h.
#include "cli/bench/bench_table.h"

#include <math.h>
#include <string.h>

static const char *text_at(const json_t *root, const char *path)
{
    const char *text = glint_json_text_at(root, path);
    return text != NULL ? text : "?";
}

// The integer at a path; 0 if it is missing.
static long long count_at(const json_t *root, const char *path)
{
    return (long long)json_integer_value(glint_json_at(root, path));
}

static double mebibytes_at(const json_t *root, const char *path)
{
    return (double)count_at(root, path) / 0x1p20;
}

void glint_bench_print_head(const json_t *document, FILE *out)
{
    double load = glint_json_real_at(document, "host.load_average");
    long long cores = count_at(document, "host.cores");
    fprintf(out, "glint %s, %s\n%s, %lld cores, %s\n", text_at(document, "glint"),
            text_at(document, "date"), text_at(document, "host.cpu"), cores,
            text_at(document, "host.system"));
    // If other processes use more than half of the cores, a launch on all cores has to wait.
    fprintf(out, "load %.2f%s\n", load,
            load > 0.5 * (double)cores ? ": the machine is busy, times are long and vary" : "");
}

static void print_error(const json_t *check, FILE *out)
{
    const json_t *error = glint_json_at(check, "error");
    const json_t *judged = glint_json_at(check, "well_conditioned_error");
    fprintf(
        out,
        "  error     relative RMSE %.2g against double precision, 99%% of the pixels within %.2g, "
        "all within %.2g\n",
        glint_json_real_at(error, "relative_rmse"), glint_json_real_at(error, "p99"),
        glint_json_real_at(error, "largest"));
    fprintf(
        out,
        "            over the %.4g%% that are well-conditioned: relative RMSE %.2g, %lld pixels "
        "off by more than 1%%\n",
        100 * (1 - glint_json_real_at(check, "ill_conditioned")),
        glint_json_real_at(judged, "relative_rmse"), count_at(judged, "differing_pixels"));
}

static void print_check(const json_t *check, FILE *out)
{
    const char *outcome = text_at(check, "outcome");
    if (strcmp(outcome, "failed") == 0) {
        fprintf(out, "  picture   WRONG: %s\n", text_at(check, "reason"));
    } else if (strcmp(outcome, "passed") != 0) {
        fprintf(out, "  picture   not checked against double precision (%s)\n", outcome);
    }
    if (glint_json_at(check, "error") != NULL) {
        print_error(check, out);
    }
}

void glint_bench_print_subject(const json_t *scene, FILE *out)
{
    const json_t *settings = glint_json_at(scene, "settings");
    fprintf(out, "\n%s: %lld triangles, %lldx%lld, samples %lld, environment %s\n",
            text_at(scene, "name"), count_at(scene, "scene.triangle_count"),
            count_at(settings, "width"), count_at(settings, "height"),
            count_at(settings, "samples"), text_at(scene, "environment.name"));
    fprintf(out, "  device    %s (%s, driver %s), %s, %lld compute units\n",
            text_at(scene, "device.name"), text_at(scene, "device.platform"),
            text_at(scene, "device.driver"), text_at(scene, "device.opencl"),
            count_at(scene, "device.compute_units"));
}

static void print_times(const char *label, const json_t *times, double frames_per_second, FILE *out)
{
    fprintf(out, "  %-16s %9.3f  %9.3f – %-9.3f  %9.3f – %-9.3f  %8.2f\n", label,
            glint_json_real_at(times, "median"), glint_json_real_at(times, "lower_quartile"),
            glint_json_real_at(times, "upper_quartile"), glint_json_real_at(times, "minimum"),
            glint_json_real_at(times, "maximum"), frames_per_second);
}

static void print_frames(const json_t *scene, FILE *out)
{
    const json_t *frames = glint_json_at(scene, "frames");
    fprintf(out, "\n  ms a frame          median              quartiles                  range"
                 "  frames/s\n");
    print_times("kernel", glint_json_at(frames, "kernel"),
                glint_json_real_at(frames, "frames_per_second"), out);
    print_times("with read-back", glint_json_at(frames, "kernel_and_readback"),
                glint_json_real_at(frames, "frames_per_second_with_readback"), out);
    fprintf(out, "  %lld frames, after the first and %lld to warm up\n",
            count_at(frames, "kernel.count"), count_at(frames, "warm_up_frames"));
}

static void print_rays(const json_t *scene, FILE *out)
{
    static const struct {
        const char *key, *label;
    } classes[] = {
        {"primary", "primary"},
        {"reflected", "reflected"},
        {"refracted_in", "refracted in"},
        {"refracted_out", "refracted out"},
        {"transmitted", "through walls"},
        {"shadow", "to lights"},
        {"all", "all"},
    };
    const json_t *rays = glint_json_at(scene, "rays");
    const json_t *rates = glint_json_at(scene, "mrays_per_second");
    fprintf(out, "\n  rays                a frame    Mrays/s\n");
    for (size_t i = 0; i < sizeof classes / sizeof *classes; i++) {
        fprintf(out, "  %-16s %10lld %10.3f\n", classes[i].label, count_at(rays, classes[i].key),
                glint_json_real_at(rates, classes[i].key));
    }
}

static void print_phases(const json_t *scene, FILE *out)
{
    static const struct {
        const char *key, *label;
    } phases[] = {
        {"load_scene", "load the scene"},
        {"load_environment", "load the environment"},
        {"analysis", "analysis and plan"},
        {"bvh", "tree"},
        {"irradiance", "irradiance map"},
        {"cells", "cells of environment"},
        {"upload", "upload"},
        {"kernel_build_cold", "kernels, cold"},
        {"kernel_build_warm", "kernels, warm"},
        {"first_frame", "first frame"},
    };
    const json_t *milliseconds = glint_json_at(scene, "milliseconds");
    fprintf(out, "\n  phases                      ms\n");
    for (size_t i = 0; i < sizeof phases / sizeof *phases; i++) {
        double value = glint_json_real_at(milliseconds, phases[i].key);
        if (!isnan(value)) {
            fprintf(out, "  %-20s %9.1f\n", phases[i].label, value);
        }
    }
}

static void print_memory(const json_t *scene, FILE *out)
{
    const json_t *memory = glint_json_at(scene, "memory");
    fprintf(
        out,
        "\n  memory    %.1f MiB on the device (scene %.1f, tree %.1f, environment %.1f, frame "
        "%.1f); process %.1f at most\n",
        mebibytes_at(memory, "device_bytes"), mebibytes_at(memory, "device_scene_bytes"),
        mebibytes_at(memory, "device_tree_bytes"), mebibytes_at(memory, "device_environment_bytes"),
        mebibytes_at(memory, "device_frame_bytes"), mebibytes_at(memory, "peak_resident_bytes"));
    fprintf(out, "  tree      %lld nodes, %lld clusters %.0f%% full, depth %lld, cost %.1f\n",
            count_at(scene, "bvh.nodes"), count_at(scene, "bvh.clusters"),
            100 * glint_json_real_at(scene, "bvh.fill"), count_at(scene, "bvh.depth"),
            glint_json_real_at(scene, "bvh.sah_cost"));
}

void glint_bench_print_scene(const json_t *scene, FILE *out)
{
    glint_bench_print_subject(scene, out);
    fprintf(out, "  plan      %s\n", text_at(scene, "plan.text"));
    print_check(glint_json_at(scene, "check"), out);
    if (glint_json_at(scene, "frames") != NULL) {
        print_frames(scene, out);
        print_rays(scene, out);
    }
    print_phases(scene, out);
    print_memory(scene, out);
}

void glint_bench_print_comparison(const json_t *comparison, FILE *out)
{
    fprintf(out, "  %-20s %s", text_at(comparison, "name"), text_at(comparison, "verdict"));
    double change = glint_json_real_at(comparison, "change");
    if (!isnan(change)) {
        fprintf(out, ": %.3f ms, was %.3f (%+.1f%%)",
                glint_json_real_at(comparison, "milliseconds_now"),
                glint_json_real_at(comparison, "milliseconds_before"), 100 * change);
    }
    fprintf(out, "\n");
}
