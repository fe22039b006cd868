#include "app/cli/throw_work.hpp"
#include "app/cli/clay_summary.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/pot_copy.hpp"

#include "app/history/work.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/tool_names.hpp"
#include "core/size_text.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

std::string tool_of(const SceneSpec& scene) {
  return fmt::format("{} {}", kToolModeNames[static_cast<std::size_t>(scene.tool.mode)],
                     kToolShapeNames[scene.tool.shape.index()]);
}

Json node_json(const history::Work& work, history::NodeId node) {
  const history::NodeView view = work.view(node);
  Json json = {{"node", node}, {"current", node == work.at()}};
  if (node > 0)
    json.update({{"parent", view.parent},
                 {"tool", tool_of(*view.scene)},
                 {"poses", view.poses},
                 {"seconds", view.seconds},
                 {"changed", view.changed.value_or(false)}});
  json["volume_mm3"] = view.volume_mm3.value_or(0.0);
  return json;
}

/// "* 3 below 1: press sphere, 2.4 s, 451.2 cm3"; the star marks the current node.
std::string line_of(const Json& node) {
  const std::string star = node["current"].get<bool>() ? "*" : " ";
  const std::string cm3 = size_text(number_field(node, "volume_mm3") / 1000.0, 1);
  if (!node.contains("parent")) return fmt::format("{} 0: initial pot, {} cm3", star, cm3);
  return fmt::format("{} {} below {}: {}, {:.2f} s, {} cm3{}", star,
                     node["node"].get<std::size_t>(), node["parent"].get<std::size_t>(),
                     node["tool"].get<std::string>(), node["seconds"].get<double>(), cm3,
                     node["changed"].get<bool>() ? "" : ", no contact");
}

Result<Json> tree_of(history::Work& work, const Console& console) {
  if (auto thrown = work.throw_all(); !thrown) return tl::make_unexpected(thrown.error());
  Json nodes = Json::array();
  for (history::NodeId node = 0; node < work.size(); ++node) {
    nodes.push_back(node_json(work, node));
    console.print(line_of(nodes.back()));
  }
  return nodes;
}

}  // namespace

Result<void> throw_work(const WorkJob& job, Console console) {
  if (job.pot_path == "-") console.quiet = true;
  Progress progress(console, "throwing", 0);
  progress.stage("reading");
  auto loaded = history::load(job.work_path);
  if (!loaded) return tl::make_unexpected(loaded.error());
  history::Work& work = loaded->work;
  if (loaded->torn)
    console.warn(job.work_path + ": the last line is incomplete; everything before it is played");
  const history::NodeId node = job.at.value_or(work.at());
  if (node >= work.size())
    return failure(ErrorKind::bad_input,
                   fmt::format("--at: expected a node of {}, from 0 to {}, found {}", job.work_path,
                               work.size() - 1, node));
  const auto named = [&](const Error& error) {
    return failure(error.kind, job.work_path + ": " + error.message);
  };
  progress.stage("replaying the strokes");
  Json json = {{"node", node}};
  if (job.list) {
    auto tree = tree_of(work, console);
    if (!tree) return named(tree.error());
    json["nodes"] = std::move(*tree);
  }
  const auto pot = work.pot(node);
  if (!pot) return named(pot.error());
  json.update(clay_json(**pot));
  if (!job.pot_path.empty()) {
    const PotEncoding encoding = pot_encoding_of(job.pot_path).value_or(PotEncoding::json);
    if (auto room = expect_room_to_write((*pot)->stack.size(), encoding, job.pot_path); !room)
      return room;
    if (auto written = publish(job.pot_path, write_pot(**pot, encoding)); !written) return written;
  }
  if (console.json) print_json(json);
  console.print(fmt::format("node {} of {}", node, work.size() - 1));
  print_clay(console, json);
  if (!job.pot_path.empty())
    console.print("pot: " + job.pot_path);
  else if (!job.list)
    console.print(kPotNotWritten);
  return {};
}

}  // namespace clay::cli
