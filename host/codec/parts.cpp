// Finds the picture in a file of several parts or layers. See parts.hpp.
//
// A layer has colour (R, G, B) or grey (Y). In a part, the unnamed layer is the picture. If a part
// has no such layer, each of its other layers is a candidate.
#include "codec/parts.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <strings.h>
#include <vector>

using OIIO::ImageInput;
using OIIO::ImageSpec;

namespace glint
{

namespace
{

// ---- Channels by name ---------------------------------------------------------------------------

// The channel "layer.name", or "name" for an empty layer.
int find_channel(const ImageSpec &spec, const std::string &layer, const char *name)
{
    std::string wanted = layer.empty() ? name : layer + "." + name;
    for (int c = 0; c < spec.nchannels; c++) {
        if (strcasecmp(spec.channelnames[std::size_t(c)].c_str(), wanted.c_str()) == 0) {
            return c;
        }
    }
    return -1;
}

Picked pick_layer(const ImageSpec &spec, const std::string &layer)
{
    Picked picked;
    for (int c = 0; c < 3; c++) {
        const char *names[] = {"R", "G", "B"};
        picked.color[c] = find_channel(spec, layer, names[c]);
    }
    // The Y of a position or a normal is not grey.
    bool is_vector = find_channel(spec, layer, "X") >= 0;
    int grey = is_vector ? -1 : find_channel(spec, layer, "Y");
    if (picked.color[0] >= 0 && picked.color[1] >= 0 && picked.color[2] >= 0) {
        picked.colors = 3;
    } else if (grey >= 0) {
        picked.color[0] = grey;
        picked.colors = 1;
    } else {
        return {};
    }
    picked.alpha = find_channel(spec, layer, "A");
    return picked;
}

std::vector<std::string> layers_of(const ImageSpec &spec)
{
    std::vector<std::string> layers;
    for (const std::string &name : spec.channelnames) {
        std::size_t dot = name.rfind('.');
        std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
        if (!layer.empty() && std::find(layers.begin(), layers.end(), layer) == layers.end()) {
            layers.push_back(layer);
        }
    }
    return layers;
}

// ---- Candidates ---------------------------------------------------------------------------------

struct Candidate {
    int part; // its index
    Picked picked;
    std::string name; // of the part, the layer, or both: "left.beauty"
    bool has_chroma;  // the grey is a luminance, with its chroma in other channels
};

// What the parts of a file hold.
struct Contents {
    std::vector<Candidate> candidates;
    std::vector<std::string> channels; // of all parts, for a message
    int parts = 0;
    bool has_deep = false;
};

bool ends_in(const std::string &text, const std::string &end)
{
    return text.size() >= end.size() &&
           strcasecmp(text.c_str() + text.size() - end.size(), end.c_str()) == 0;
}

void add_layer(int part, const ImageSpec &spec, const std::string &layer, Contents &contents)
{
    Candidate found = {part, pick_layer(spec, layer), "", false};
    if (found.picked.colors == 0) {
        return;
    }
    found.name = spec.get_string_attribute("oiio:subimagename");
    if (!layer.empty() && !ends_in(found.name, layer)) {
        found.name += (found.name.empty() ? "" : ".") + layer;
    }
    found.has_chroma = found.picked.colors == 1 && (find_channel(spec, layer, "RY") >= 0 ||
                                                    find_channel(spec, layer, "BY") >= 0);
    contents.candidates.push_back(found);
}

void add_part(int part, const ImageSpec &spec, Contents &contents)
{
    const std::size_t before = contents.candidates.size();
    add_layer(part, spec, "", contents);
    if (contents.candidates.size() > before) {
        return;
    }
    for (const std::string &layer : layers_of(spec)) {
        add_layer(part, spec, layer, contents);
    }
}

// A file's only channel is grey, whatever its name.
void add_only_channel(int part, Contents &contents)
{
    Candidate found = {part, {}, "", false};
    found.picked.color[0] = 0;
    found.picked.colors = 1;
    contents.candidates.push_back(found);
}

glint_status list_contents(const glint_codec_request &request, ImageInput &input,
                           Contents &contents, glint_error *error)
{
    const bool is_exr = std::strcmp(request.plugin, "openexr") == 0;
    for (int index = 0; index < 1000 && input.seek_subimage(index, 0); index++) {
        const ImageSpec spec = input.spec(index, 0);
        contents.parts++;
        contents.has_deep = contents.has_deep || spec.deep;
        if (spec.deep) {
            continue;
        }
        if (spec.nchannels > GLINT_PICTURE_CHANNELS_MAX) {
            return glint_fail(error, GLINT_BAD_INPUT,
                              "%s: %d channels are more than the %d that are read (save the wanted "
                              "ones alone)",
                              request.path, spec.nchannels, GLINT_PICTURE_CHANNELS_MAX);
        }
        add_part(index, spec, contents);
        contents.channels.insert(contents.channels.end(), spec.channelnames.begin(),
                                 spec.channelnames.end());
        if (!is_exr && !contents.candidates.empty()) {
            break; // further pages
        }
    }
    (void)input.geterror(); // the end of the parts is no error
    if (contents.candidates.empty() && contents.parts == 1 && contents.channels.size() == 1) {
        add_only_channel(0, contents);
    }
    return GLINT_OK;
}

// ---- The choice ---------------------------------------------------------------------------------

// The only candidate that is wanted; nullptr if there is none, or more than one. `count` says how
// many.
template <typename Test>
const Candidate *find_only(const std::vector<Candidate> &candidates, const Test &is_wanted,
                           int &count)
{
    const Candidate *found = nullptr;
    count = 0;
    for (const Candidate &candidate : candidates) {
        if (is_wanted(candidate)) {
            found = &candidate;
            count++;
        }
    }
    return count == 1 ? found : nullptr;
}

// True if this is the candidate's name, or the end of it after a dot.
bool is_named(const Candidate &candidate, const char *name)
{
    const std::size_t dot = candidate.name.rfind('.');
    const std::size_t last = dot == std::string::npos ? 0 : dot + 1;
    return strcasecmp(candidate.name.c_str() + last, name) == 0;
}

// nullptr if there is none, or if it is not clear which one it is.
const Candidate *choose(const std::vector<Candidate> &candidates)
{
    // How OpenEXR and Nuke, Houdini, others, and Blender call the final picture.
    static const char *const names[] = {"rgba", "rgb", "C", "beauty", "combined"};
    if (candidates.size() == 1) {
        return &candidates[0];
    }
    int count = 0;
    for (const char *name : names) {
        const Candidate *named = find_only(
            candidates, [name](const Candidate &of) { return is_named(of, name); }, count);
        if (count > 0) {
            return named;
        }
    }
    return find_only(
        candidates, [](const Candidate &of) { return of.picked.colors == 3; }, count);
}

// Lists names for a message: the first ones, then "…".
std::string list_names(const std::vector<std::string> &from)
{
    const std::size_t most = 8;
    std::string names;
    for (std::size_t i = 0; i < from.size() && i <= most; i++) {
        names += (names.empty() ? "" : ", ") + (i < most ? from[i] : "…");
    }
    return names;
}

glint_status refuse(const char *path, const Contents &contents, glint_error *error)
{
    std::vector<std::string> names;
    for (const Candidate &candidate : contents.candidates) {
        names.push_back(candidate.name);
    }
    if (!names.empty()) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: holds several pictures: %s (save the wanted one alone, or call it "
                          "rgba)",
                          path, list_names(names).c_str());
    }
    if (contents.has_deep) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: holds deep pixels, which are not read (flatten it)", path);
    }
    return glint_fail(error, GLINT_BAD_INPUT,
                      "%s: no channels R, G, B or Y among its %s (rename them)", path,
                      list_names(contents.channels).c_str());
}

} // namespace

glint_status find_part(const glint_codec_request &request, ImageInput &input, Part &part,
                       glint_error *error)
{
    Contents contents;
    TRY(list_contents(request, input, contents, error));
    const Candidate *chosen = choose(contents.candidates);
    if (chosen == nullptr) {
        return refuse(request.path, contents, error);
    }
    if (chosen->has_chroma) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: holds luminance and chroma (Y, RY, BY), which are not read (save it "
                          "as R, G, B)",
                          request.path);
    }
    part = {chosen->part, input.spec(chosen->part, 0), chosen->picked};
    return GLINT_OK;
}

} // namespace glint
