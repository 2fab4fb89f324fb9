#include "cfem_cutting/io/replay_options.h"

#include <CLI/CLI.hpp>
#include <cmath>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {

struct Parsed {
  ReplayOptions options;
  std::vector<std::string> follow;  // FRAME=FILE
};

void declare(CLI::App& app, Parsed& parsed) {
  ReplayOptions& o = parsed.options;
  app.add_option("--config", o.config, "Configuration (YAML)")->type_name("FILE.yaml");
  app.add_option("--set", o.overrides,
                 "Override a key, such as tissue.materials[0].density or tissue.materials.0.density; "
                 "may be repeated")
      ->type_name("key.path=value")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--bag", o.bag, "Poses and tf from a bag")->type_name("FILE.bag");
  app.add_option("--poses", o.poses, "Poses from a table t,x,y,z,qx,qy,qz,qw in the tissue frame")
      ->type_name("FILE.csv");
  app.add_option("--duration", o.duration, "Simulate without a tool")->type_name("SECONDS");
  app.add_option("--out", o.out, "Folder for the results")->type_name("DIR");
  app.add_option("--topic", o.topic, "Topic of the tool's poses in the bag")->type_name("NAME");
  app.add_option("--follow", parsed.follow, "Poses of a followed frame, as --poses; may be repeated")
      ->type_name("FRAME=FILE.csv")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--surface-every", o.surface_every, "Write the surface at this interval")
      ->type_name("SECONDS");
  app.add_flag("--list-parameters", o.list_parameters, "Print all configuration keys as Markdown");
}

void read_follow(Parsed& parsed) {
  for (const std::string& text : parsed.follow) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw ConfigError("--follow " + text + ": must be FRAME=FILE.csv");
    if (!parsed.options.follow.emplace(text.substr(0, equals), text.substr(equals + 1)).second)
      throw ConfigError("--follow " + text + ": the frame is given twice");
  }
}

void check(const CLI::App& app, const ReplayOptions& options) {
  if (options.config.empty()) throw ConfigError("--config is required; see --help");
  if (options.out.empty()) throw ConfigError("--out is required; see --help");
  const std::size_t sources =
      (app.count("--bag") > 0) + (app.count("--poses") > 0) + (app.count("--duration") > 0);
  if (sources != 1) throw ConfigError("exactly one of --bag, --poses and --duration is required; see --help");
  if (app.count("--duration") > 0 && !(options.duration > 0.0 && std::isfinite(options.duration)))
    throw ConfigError("--duration: must be a number > 0");
  if (app.count("--surface-every") > 0 &&
      !(options.surface_every > 0.0 && std::isfinite(options.surface_every)))
    throw ConfigError("--surface-every: must be a number > 0");
}

}  // namespace

ReplayOptions parse_replay_options(int argc, const char* const* argv) {
  CLI::App app("Cuts tissue with recorded tool poses, without a ROS master.", "replay");
  Parsed parsed;
  declare(app, parsed);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    parsed.options.help = true;
    parsed.options.help_text = app.help();
    return parsed.options;
  } catch (const CLI::ParseError& error) {
    throw ConfigError(std::string(error.what()) + "; see --help");
  }
  if (parsed.options.list_parameters) return parsed.options;
  read_follow(parsed);
  check(app, parsed.options);
  return parsed.options;
}

}  // namespace cfem_cutting
