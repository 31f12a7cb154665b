// A scene file as a whole.
#include <optional>

#include "common/dataset/text_file.hpp"
#include "common/scene_file/scene_sections.hpp"

namespace tsg {
namespace {

using simulation::SceneDescription;

/// Nothing where it is not YAML, or not that of a scene; reported.
std::optional<YAML::Node> parse(const std::string& text, SceneProblems& problems) {
  try {
    YAML::Node root = YAML::Load(text);
    if (root.IsMap()) return root;
    problems.add(1, "",
                 root.IsNull() ? "the file is empty; docs/simulation.md says what a scene has"
                               : "must hold the keys of a scene, e.g. 'rooms:'");
  } catch (const YAML::Exception& error) {
    problems.add(error.mark.line + 1, "", "not valid YAML: " + error.msg);
  }
  return {};
}

SceneDescription read_scene(const YAML::Node& node, SceneContext& context) {
  SceneDescription scene;
  MapReader root(node, "", context.problems);
  if (root.require({"rooms"}) && root.is_list("rooms") && root.list("rooms").empty()) {
    root.add_problem("rooms", "must have at least one");
  }
  root.read("name", scene.name);
  root.read("description", scene.description);
  root.read("duration_s", scene.duration_s, {0.1, 86'400.0});
  root.read("seed", scene.seed);
  read_rooms(root, context, scene);
  read_openings(root, context, scene);
  read_objects(root, context, scene);
  read_people(root, context, scene);
  read_relocations(root, context, scene);
  read_moves(root, context, scene);
  read_camera(root, context, scene);
  read_sensor(root, context, scene);
  root.finish();
  context.names.check(context.problems);
  return scene;
}

}  // namespace

Expected<SceneDescription> load_scene_with(const Catalogue& catalogue,
                                           const std::filesystem::path& file) {
  const auto text = read_text_file(file, "give a scene file (docs/simulation.md)");
  if (!text) return tl::unexpected(text.error());
  SceneProblems problems(file);
  const auto root = parse(*text, problems);
  if (!root) return tl::unexpected(problems.to_error());
  SceneContext context{catalogue, file.parent_path(), problems};
  SceneDescription scene = read_scene(*root, context);
  if (!problems.empty()) return tl::unexpected(problems.to_error());
  if (scene.name.empty()) scene.name = file.stem().string();
  return scene;
}

}  // namespace tsg
