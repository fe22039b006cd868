#include "app/cli/commands.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/pot_input.hpp"
#include "app/cli/render_job.hpp"
#include "app/cli/usage.hpp"
#include "core/number_parsing.hpp"
#include "core/size_text.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

std::optional<render::Viewport> size_of(std::string_view text) {
  const auto size = two_numbers<int>(text, 'x');
  const auto fits = [](int side) { return side >= 1 && side <= render::kMaxSidePx; };
  if (!size || !fits(size->first) || !fits(size->second)) return std::nullopt;
  return render::Viewport{size->first, size->second};
}

void add_size(CLI::App& sub, RenderCommand& command) {
  sub.add_option_function<std::string>(
         "--size", [&command](const std::string& text) { command.size_asked = size_of(text); },
         "Size [px] (default: 1280x720 of a picture, 640x360 of a turntable)")
      ->type_name("WIDTHxHEIGHT")
      ->check([](const std::string& text) {
        return size_of(text) ? std::string()
                             : fmt::format("expected WIDTHxHEIGHT, 1x1 to {0}x{0}, found {1}",
                                           render::kMaxSidePx, text);
      });
}

void add_material(CLI::App& sub, render::PictureChoices& choices) {
  sub.add_option_function<std::string>(
         "--material", [&choices](const std::string& id) { choices.material = *find_material(id); },
         "Clay or glaze of the surface")
      ->check(one_of(material_ids()))
      ->default_str(std::string(choices.material.id));
}

void add_look(CLI::App& sub, render::PictureChoices& choices) {
  sub.add_option_function<std::string>(
         "--theme",
         [&choices](const std::string& name) {
           choices.theme = name == "dark" ? render::Theme::dark : render::Theme::light;
         },
         "Theme of the picture: light or dark")
      ->check(one_of({"light", "dark"}))
      ->default_str("light");
  sub.add_option_function<std::string>(
         "--style",
         [&choices](const std::string& name) {
           choices.style = name == "clay" ? render::Style::clay : render::Style::geometry;
         },
         "geometry: the exact shape of the pot; clay: with throwing lines, specks, a rounded rim "
         "and a bare foot below a glaze, which are not in the pot")
      ->check(one_of({"geometry", "clay"}))
      ->default_str("geometry");
  add_material(sub, choices);
  sub.add_flag("--transparent", choices.alone,
               "Draw the pot alone, without wheel, on a transparent background (not in a GIF)");
}

void add_camera(CLI::App& sub, render::PictureChoices& choices) {
  sub.add_option("--azimuth", choices.azimuth_deg, "Camera azimuth [deg] (default: about 34)")
      ->check(in_range(-3600.0, 3600.0));
  sub.add_option("--elevation", choices.elevation_deg, "Camera elevation [deg] (default: about 24)")
      ->check(in_range(-89.0, 89.0));
}

std::string text_of(render::Viewport size) {
  return fmt::format("{} x {} px", size.width_px, size.height_px);
}

void print_picture(const Console& console, const RenderCommand& command, const Rendered& done) {
  const std::string size = text_of(command.choices.size);
  if (!command.out.empty() && command.out != "-")
    console.print(fmt::format("{}: {}, {} bytes{}", command.out, size, done.png_bytes,
                              command.choices.style == render::Style::clay
                                  ? "; its throwing lines and rounded rim are not in the pot"
                                  : ""));
  if (!command.turntable.empty() && command.turntable != "-")
    console.print(fmt::format("{}: {} of {}, {} bytes", command.turntable,
                              counted(static_cast<std::size_t>(command.choices.frames), "frame"),
                              text_of(command.turntable_size), done.gif_bytes));
  if (done.map)
    console.print(fmt::format(
        "walls: dark violet 0 mm to yellow {:g} mm{}; thinnest {} mm", done.map->top_mm,
        done.map->limit_mm > 0.0 ? fmt::format(", hatched red below {:.4g} mm", done.map->stated_mm)
                                 : std::string(),
        bound_text(*done.thinnest_mm, 3)));
  if (done.frame)
    console.print(fmt::format("{:.1f} ms a frame of {}, {:.1f} ms anti-aliased, on {}",
                              done.frame->ms, size, done.frame->anti_aliased_ms, done.renderer));
}

std::string_view style_name(render::Style style) {
  return style == render::Style::clay ? "clay" : "geometry";
}

Json rendered_json(const RenderCommand& command, const Rendered& done) {
  Json json = {{"pot", command.pot},
               {"width_px", command.choices.size.width_px},
               {"height_px", command.choices.size.height_px},
               {"style", style_name(command.choices.style)},
               {"material", command.choices.material.id},
               {"renderer", done.renderer}};
  if (!command.out.empty()) json["png"] = {{"path", command.out}, {"bytes", done.png_bytes}};
  if (!command.turntable.empty())
    json["gif"] = {{"path", command.turntable},
                   {"bytes", done.gif_bytes},
                   {"frames", command.choices.frames},
                   {"width_px", command.turntable_size.width_px},
                   {"height_px", command.turntable_size.height_px}};
  if (done.map)
    json["wall_map"] = {{"limit_mm", done.map->limit_mm},
                        {"top_mm", done.map->top_mm},
                        {"thinnest_mm", *done.thinnest_mm}};
  if (done.frame)
    json["frame"] = {{"ms", done.frame->ms}, {"anti_aliased_ms", done.frame->anti_aliased_ms}};
  return json;
}

int run(RenderCommand& command, Console console) {
#ifdef CLAYSTACK_EXPORT
  if (auto loaded = command.walls.load(); !loaded) return report(loaded.error());
  if (command.walls.asked()) command.wall_map = true;
#endif
  if (command.frames_asked) command.choices.frames = *command.frames_asked;
  if (command.size_asked) command.choices.size = command.turntable_size = *command.size_asked;
  if (command.out.empty() && !command.time) command.choices.size = command.turntable_size;
  const auto done = render(command, console);
  if (!done) return report(done.error());
  if (console.json) print_json(rendered_json(command, *done));
  if (command.out == "-" || command.turntable == "-") console.quiet = true;
  print_picture(console, command, *done);
  return kDone;
}

}  // namespace

void add_render_command(CLI::App& app, Console& console, int& exit) {
  auto command = std::make_shared<RenderCommand>();
  CLI::App* sub =
      app.add_subcommand("render", "Draw a pot without a screen, as a picture or a turntable");
  add_file(*sub, "pot", command->pot,
           std::string(kPotInputs) +
               ", or - for standard input; for a NAME.scene.json its lump is drawn")
      ->required();
  add_file(*sub, "-o,--output", command->out,
           "File for the picture, .png, or - for standard output");
  add_file(*sub, "--turntable", command->turntable,
           "File for an animation of one turn, .gif, or - for standard output");
  sub->add_option("--frames", command->frames_asked, "Number of frames of the turntable")
      ->check(in_whole_range(1, render::kMostFrames))
      ->default_str(std::to_string(command->choices.frames));
  add_size(*sub, *command);
  sub->add_flag("--section", command->choices.section, "Cut the pot open to show its walls");
#ifdef CLAYSTACK_EXPORT
  sub->add_flag("--wall-map", command->wall_map,
                "Show wall thickness as colours; walls below --min-wall or --process are hatched");
  command->walls.add_to(*sub);
#endif
  add_look(*sub, command->choices);
  add_camera(*sub, command->choices);
  sub->add_flag("--time", command->time, "Print the median time of a frame [ms]");
  sub->footer(
      "\nExamples:\n"
      "  claystack throw samples/vase.scene.json -o vase.pot.json\n"
      "  claystack render vase.pot.json -o vase.png\n"
      "  claystack render vase.pot.json -o walls.png --section --process porcelain\n"
      "  claystack render vase.pot.json -o glazed.png --material celadon --style clay\n"
      "  claystack render vase.pot.json --turntable vase.gif --size 480x480 --theme dark");
  sub->callback([command, &console, &exit] { exit = run(*command, console); });
}

}  // namespace clay::cli
