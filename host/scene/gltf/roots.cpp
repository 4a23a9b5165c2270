// Finds the root nodes that a scene shows. See roots.hpp.
#include "scene/gltf/roots.hpp"

#include "scene/gltf/extensions.hpp"

namespace glint
{

namespace
{

std::vector<std::string> names_of(const std::vector<tinygltf::Scene> &scenes)
{
    std::vector<std::string> names;
    names.reserve(scenes.size());
    for (const tinygltf::Scene &scene : scenes) {
        names.push_back(scene.name);
    }
    return names;
}

// Whether an ancestor of a node is listed.
enum class Below : char { unknown, none, listed };

// Finds whether an ancestor of a node is listed. Each ancestor is asked once, so all calls together
// take linear time.
bool is_below_listed(const Model &model, int node, const std::vector<bool> &is_listed,
                     std::vector<Below> &below)
{
    std::vector<std::size_t> way;
    Below found = Below::none;
    for (int up = node; up >= 0; up = model.parents[static_cast<std::size_t>(up)]) {
        const auto at = static_cast<std::size_t>(up);
        if (below[at] != Below::unknown || (up != node && is_listed[at])) {
            found = up != node && is_listed[at] ? Below::listed : below[at];
            break;
        }
        way.push_back(at);
    }
    for (const std::size_t passed : way) {
        below[passed] = found;
    }
    return found == Below::listed;
}

// Returns the roots among the nodes that a scene lists. A scene should list roots, each once. Nodes
// with a parent are drawn once: in the parent's tree if the scene shows it, else as roots, as
// three.js does.
std::vector<int> settle_roots(Load &load, const std::vector<int> &listed)
{
    const Model &model = load.model;
    std::vector<bool> is_listed(model.nodes.size());
    for (const int node : listed) {
        is_listed[static_cast<std::size_t>(node)] = true;
    }
    std::vector<Below> below(model.nodes.size(), Below::unknown);
    std::vector<bool> is_met(model.nodes.size());
    std::vector<int> roots;
    for (const int node : listed) {
        const auto at = static_cast<std::size_t>(node);
        const std::string where = node_where(load, at);
        if (is_met[at]) {
            load.tally.add("the scene lists the node twice (it is drawn once)", where);
            continue;
        }
        is_met[at] = true;
        if (is_below_listed(model, node, is_listed, below)) {
            load.tally.add("the scene lists the node, and shows it below its parent, too (it is "
                           "drawn once, there)",
                           where);
            continue;
        }
        if (model.parents[at] >= 0) {
            load.tally.add("the scene lists the node, but not its parent (it is drawn where it "
                           "stands without the parent)",
                           where);
        }
        roots.push_back(node);
    }
    return roots;
}

} // namespace

std::string node_where(const Load &load, std::size_t node)
{
    const std::string &name = load.model.nodes[node].name;
    return "nodes[" + std::to_string(node) + "]" + (name.empty() ? "" : " " + in_quotes(name));
}

std::vector<int> find_roots(Load &load, const char *name)
{
    const Model &model = load.model;
    if (name != nullptr || !model.scenes.empty()) {
        std::size_t scene = name != nullptr ? find_named(names_of(model.scenes), name, "scene")
                            : model.defaultScene >= 0 ? static_cast<std::size_t>(model.defaultScene)
                                                      : 0;
        survey_extensions(objects_of(load.document.root, "scenes")[scene], Holder::scene,
                          "scenes[" + std::to_string(scene) + "]", load.tally);
        return settle_roots(load, model.scenes[scene].nodes);
    }
    // glTF calls such a file a library. A user who renders it wants to see its contents.
    std::vector<int> roots;
    for (std::size_t i = 0; i < model.nodes.size(); i++) {
        if (load.model.parents[i] < 0) {
            roots.push_back(static_cast<int>(i));
        }
    }
    if (!roots.empty()) {
        load.tally.add("missing, so that every root node is shown", "scenes");
    }
    return roots;
}

} // namespace glint
