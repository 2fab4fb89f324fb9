/// Makes random cuts and compares them with exact oracles; see --help.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "trial.h"

using namespace cfem_cutting::random_cuts;

namespace {

struct Summary {
  std::int64_t cuts = 0, failed = 0, links = 0, separated = 0;
  double volume_error = 0.0;
  SurfaceFigures surface;

  void add(const Outcome& outcome) {
    ++cuts;
    failed += !outcome.failures.empty();
    links += outcome.links_severed;
    separated += outcome.pieces > 1;
    volume_error = std::max(volume_error, outcome.volume_error);
    surface.add(outcome.surface);
  }

  void print() const {
    const auto percent = [&](std::int64_t n) {
      return 100.0 * n / std::max<std::int64_t>(1, surface.triangles);
    };
    std::printf("%ld cuts, %ld failed; %ld links severed, %ld cuts separated the tissue\n", cuts, failed,
                links, separated);
    std::printf(
        "surface: volume off by %.2f %% at most; %ld triangles, %ld without area, %ld flipped, "
        "%.3f %% under 5 degrees, %.4f %% meet others\n",
        100.0 * volume_error, surface.triangles, surface.without_area, surface.flipped,
        percent(surface.needles), percent(surface.crossing));
  }
};

void print_failures(std::uint64_t seed, const Outcome& outcome) {
  for (const std::string& failure : outcome.failures)
    std::printf("cut %lu (%s): %s\n", seed, outcome.description.c_str(), failure.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  std::uint64_t first = 0;
  std::uint64_t count = 100;
  const std::map<std::string, Kind> kinds{
      {"through", Kind::kThrough}, {"stopped", Kind::kStopped}, {"crossing", Kind::kCrossing}};
  CLI::App app("Random cuts against exact oracles; cut k follows from seed k");
  app.add_option("--first", first, "Seed of the first cut");
  app.add_option("--count", count, "Number of cuts");
  app.add_option("--kind", options.kind, "through, stopped or crossing")
      ->transform(CLI::CheckedTransformer(kinds));
  app.add_option("--bunny", options.bunny, "Mesh file")->required();
  app.add_flag("--self-crossings", options.self_crossings, "Look for triangles that meet others (slow)");
  CLI11_PARSE(app, argc, argv);
  Summary summary;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Outcome outcome = try_cut(seed, options);
    print_failures(seed, outcome);
    summary.add(outcome);
  }
  summary.print();
  return summary.failed == 0 ? 0 : 1;
}
