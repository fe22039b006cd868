#include "app/studio/settings.hpp"

#include "app/studio/units.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace clay::studio {
namespace {

Settings changed() {
  Settings settings;
  settings.theme = Theme::light;
  settings.theme_chosen = true;
  settings.scale = 1.5f;
  settings.unit = LengthUnit::in;
  settings.wheel_rpm = 90.0;
  settings.tool.shape = Shape::rib;
  settings.tool.mode = ToolMode::pinch;
  settings.tool.rib = {25.0, 4.0};
  settings.hints = false;
  settings.wall_map = settings.full_section = true;
  settings.process = "porcelain";
  settings.open["force"] = false;
  settings.folder = "/pots";
  settings.material = *find_material("tenmoku");
  settings.throwing_lines = false;
  return settings;
}

TEST(Settings, RoundTrip) {
  const std::string text = write_settings(changed());
  const auto back = parse_settings(text, "studio.json");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(write_settings(*back), text);
  EXPECT_EQ(back->tool.rib, changed().tool.rib);
  EXPECT_EQ(back->theme, Theme::light);
  EXPECT_TRUE(back->theme_chosen);
  EXPECT_EQ(back->material.id, "tenmoku");
  EXPECT_FALSE(back->throwing_lines);
}

TEST(Settings, CanBeReadAfterASceneWithALargeTool) {
  Settings settings;
  for (const ToolShapeSpec& shape :
       {ToolShapeSpec(SphereSpec{5000.0}), ToolShapeSpec(SphereSpec{0.01}),
        ToolShapeSpec(EllipseSpec{80.0, 900.0}), ToolShapeSpec(RibSpec{70.0, 61.0})}) {
    ToolSpec tool;
    tool.shape = shape;
    choose(tool, settings.tool);
    const auto back = parse_settings(write_settings(settings), "studio.json");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_LE(back->tool.sphere.radius_mm, kLargestToolMm);
    EXPECT_GE(back->tool.sphere.radius_mm, kSmallestToolMm);
  }
}

TEST(Settings, RoundTripEveryScaleAndUnit) {
  for (const float scale : {0.5f, 1.1f, 3.0f})
    for (const LengthUnit unit : {LengthUnit::mm, LengthUnit::cm, LengthUnit::in}) {
      Settings settings;
      settings.scale = scale;
      settings.unit = unit;
      const auto back = parse_settings(write_settings(settings), "s");
      ASSERT_TRUE(back) << back.error().message;
      EXPECT_EQ(back->scale, scale);
      EXPECT_EQ(back->unit, unit);
    }
  for (const float scale : {0.49f, 3.01f}) {
    Settings settings;
    settings.scale = scale;
    EXPECT_FALSE(parse_settings(write_settings(settings), "s"));
  }
}

TEST(LengthText, UsesTheChosenUnit) {
  EXPECT_EQ(length_text(50.8, LengthUnit::mm), "50.8 mm");
  EXPECT_EQ(length_text(50.8, LengthUnit::cm), "5.08 cm");
  EXPECT_EQ(length_text(50.8, LengthUnit::in), "2.00 in");
}

TEST(LengthText, SpeedsAndTolerancesUseItToo) {
  EXPECT_EQ(speed_text(80.0, LengthUnit::mm), "80 mm/s");
  EXPECT_EQ(speed_text(80.0, LengthUnit::in), "3.1 in/s");
  EXPECT_EQ(tolerance_text(0.02, LengthUnit::mm), "0.02 mm");
  EXPECT_EQ(tolerance_text(0.02, LengthUnit::in), "0.000787 in");
}

TEST(MassText, ARoundedKilogramIsAKilogram) {
  EXPECT_EQ(mass_text(999.94), "999.9 g");
  for (const double grams : {999.96, 999.999999, 1000.0, 1000.000001})
    EXPECT_EQ(mass_text(grams), "1.000 kg") << grams;
  EXPECT_EQ(short_mass_text(999.4), "999 g");
  for (const double grams : {999.5, 999.999999, 1000.0})
    EXPECT_EQ(short_mass_text(grams), "1.00 kg") << grams;
  EXPECT_EQ(capacity_text(999.4e3), "999 ml");
  EXPECT_EQ(capacity_text(999.6e3), "1.00 l");
  EXPECT_EQ(capacity_text(9.94e3), "9.9 ml");
  EXPECT_EQ(capacity_text(9.96e3), "10 ml");
}

TEST(Settings, RemembersCustomProcesses) {
  Settings settings;
  for (const char* name : {"/a", "/b", "/c", "/d", "/e", "/b"})
    remember_process(settings, std::string(name) + ".process.json");
  EXPECT_EQ(settings.process, "/b.process.json");
  EXPECT_EQ(settings.processes, (std::vector<std::string>{"/b.process.json", "/e.process.json",
                                                          "/d.process.json", "/c.process.json"}));
  const auto back = parse_settings(write_settings(settings), "s");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->processes, settings.processes);
}

TEST(Settings, ErrorsNameTheField) {
  const auto error_of = [](const std::string& field) {
    const auto read = parse_settings("{\"schema\": \"claystack-studio-1\", " + field + "}", "s");
    return read ? std::string("none") : read.error().message;
  };
  EXPECT_EQ(error_of("\"scale\": 9"), "s:1: scale: expected a number from 0.5 to 3, found 9");
  EXPECT_EQ(error_of("\"theme\": \"pink\""),
            "s:1: theme: expected one of dark, light, found \"pink\"");
  EXPECT_EQ(error_of("\"hints\": 1"), "s:1: hints: expected true or false, found 1");
  EXPECT_EQ(error_of("\"colour\": 1").find("s:1: unknown field \"colour\"; expected one of"), 0u);
  EXPECT_EQ(error_of("\"open\": {\"tool\": 3}"), "s:1: open.tool: expected true or false, found 3");
  EXPECT_EQ(parse_settings("[]", "s").error().message,
            "s:1: expected an object, found an array of 0");
  EXPECT_EQ(parse_settings("{}", "s").error().message,
            "s:1: expected a field \"schema\", found none");
}

// The error message once repeated the value level by level until the stack overflowed.
TEST(Settings, RefuseADeeplyNestedFile) {
  std::string deep = "{\"schema\": \"claystack-studio-1\", \"scale\": ";
  deep.append(100'000, '[').append(100'000, ']').append("}");
  const auto read = parse_settings(deep, "s");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, "s:1: expected at most 64 levels, found more");
  const std::string long_text(500'000, 'x');
  EXPECT_LT(
      parse_settings("{\"schema\": \"claystack-studio-1\", \"scale\": \"" + long_text + "\"}", "s")
          .error()
          .message.size(),
      300u);
}

TEST(Settings, RefusesAPipe) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("studio.json");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_NE(load_settings(path).note.find("expected a regular file"), std::string::npos);
  const auto saved = SettingsFile(path, Settings()).save(changed());
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().kind, ErrorKind::io);
}

TEST(Settings, UseThePasswordFileWithoutHome) {
  setenv("XDG_CONFIG_HOME", "relative", 1);
  unsetenv("HOME");
  EXPECT_EQ(settings_path(),
            std::string(getpwuid(getuid())->pw_dir) + "/.config/claystack/studio.json");
  setenv("HOME", "relative", 1);
  EXPECT_EQ(settings_path(),
            std::string(getpwuid(getuid())->pw_dir) + "/.config/claystack/studio.json");
  setenv("XDG_CONFIG_HOME", "/etc/xdg", 1);
  EXPECT_EQ(settings_path(), "/etc/xdg/claystack/studio.json");
}

TEST(Settings, RenamesABrokenFile) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("studio.json");
  test::write_text(path, "{ not json");
  const LoadedSettings loaded = load_settings(path);
  EXPECT_NE(loaded.note.find(".broken"), std::string::npos) << loaded.note;
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(test::read_text(path + ".broken"), "{ not json");
  EXPECT_EQ(write_settings(loaded.settings), write_settings(Settings()));
}

TEST(Settings, KeepsAFileThatItCanNeitherReadNorRename) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("studio.json");
  test::write_text(path, "{ not json");
  std::filesystem::create_directories(path + ".broken/full");
  const LoadedSettings broken = load_settings(path);
  EXPECT_FALSE(broken.may_save);
  EXPECT_NE(broken.note.find("will not be saved"), std::string::npos) << broken.note;
  test::write_text(path, std::string(20'000'000, ' '));
  EXPECT_FALSE(load_settings(path).may_save) << "too large";
  ASSERT_TRUE(SettingsFile(path, Settings()).save(changed()));
  EXPECT_TRUE(load_settings(path).may_save);
}

TEST(Settings, AMissingFileIsNotAnError) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("deep/er/studio.json");
  EXPECT_EQ(load_settings(path).note, "");
  ASSERT_TRUE(SettingsFile(path, Settings()).save(changed()));
  EXPECT_EQ(write_settings(load_settings(path).settings), write_settings(changed()));
}

TEST(SettingsFile, SavesChangesAtMostOnceASecond) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("studio.json");
  Settings settings;
  SettingsFile file(path, settings);
  ASSERT_TRUE(file.update(settings, 0.0));
  EXPECT_FALSE(std::filesystem::exists(path)) << "nothing has changed";
  settings = changed();
  ASSERT_TRUE(file.update(settings, 0.5));
  EXPECT_FALSE(std::filesystem::exists(path)) << "less than a second later";
  ASSERT_TRUE(file.update(settings, 1.5));
  EXPECT_EQ(test::read_text(path), write_settings(changed()));
}

TEST(SettingsFile, KeepsWhatAnotherWindowHasChanged) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("studio.json");
  Settings first, second;
  SettingsFile of_first(path, first), of_second(path, second);
  first.unit = LengthUnit::in;
  first.open = {{"force", false}};
  ASSERT_TRUE(of_first.save(first));
  second.wheel_rpm = 90.0;
  second.open = {{"walls", true}};
  ASSERT_TRUE(of_second.save(second));
  const auto stored = [&] { return load_settings(path).settings; };
  EXPECT_EQ(stored().unit, LengthUnit::in);
  EXPECT_EQ(stored().wheel_rpm, 90.0);
  EXPECT_EQ(stored().open, (std::map<std::string, bool>{{"force", false}, {"walls", true}}));
  first.wheel_rpm = 60.0;
  ASSERT_TRUE(of_first.save(first));
  second.wall_map = true;
  ASSERT_TRUE(of_second.save(second));
  EXPECT_EQ(stored().wheel_rpm, 60.0) << "the second window has not changed it again";
  EXPECT_TRUE(stored().wall_map);
}

TEST(SettingsFile, WritesItsOwnSettingsWhereTheFileIsDamaged) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("studio.json");
  SettingsFile file(path, Settings());
  test::write_text(path, "{\"schema\": 7}");
  ASSERT_TRUE(file.save(changed()));
  EXPECT_EQ(test::read_text(path), write_settings(changed()));
}

/// `--theme` and `--scale` are for one window.
TEST(SettingsFile, StoresTheLookOfTheCommandLineOnlyWhenTheUserChangesIt) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("studio.json");
  const auto stored = [&] { return load_settings(path).settings; };
  Settings window;
  window.theme = Theme::light;
  window.scale = 2.0f;
  ASSERT_EQ(Settings().theme, Theme::dark);
  SettingsFile file(path, Settings(), window);
  window.wall_map = true;
  ASSERT_TRUE(file.save(window));
  EXPECT_TRUE(stored().wall_map);
  EXPECT_EQ(stored().theme, Theme::dark);
  EXPECT_EQ(stored().scale, 1.0f);
  window.scale = 1.5f;
  ASSERT_TRUE(file.save(window));
  EXPECT_EQ(stored().theme, Theme::dark);
  EXPECT_EQ(stored().scale, 1.5f);
  window.scale = 2.0f;
  ASSERT_TRUE(file.save(window));
  EXPECT_EQ(stored().scale, 2.0f) << "now by the user";
}

TEST(SettingsFile, ReportsAFailureOnce) {
  const test::ScratchFolder folder;
  test::write_text(folder.file("file"), "");
  SettingsFile file(folder.file("file") + "/studio.json", Settings());
  EXPECT_FALSE(file.update(changed(), 0.0));
  EXPECT_TRUE(file.update(changed(), 10.0)) << "already reported";
  EXPECT_FALSE(file.save(changed()));
}

}  // namespace
}  // namespace clay::studio
