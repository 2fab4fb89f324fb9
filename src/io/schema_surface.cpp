#include "rules.h"
#include "schema.h"

namespace cfem_cutting {
namespace {

Fields<LabelColour> label_colour_fields() {
  using L = LabelColour;
  return {
      required(field<L>(
          "label", "", integer(0, 255), [](L & l) -> auto& { return l.label; },
          "Label of the volume; a box or a mesh has 0.")),
      required(field<L>(
          "colour", "", colour(), [](L & l) -> auto& { return l.colour; },
          "Red, green, blue, of skin and cut faces alike.")),
  };
}

void check_label_colour(const Value& value, const LabelColour&) {
  if (!value.node["label"] || !value.node["colour"]) refuse(value, "{label: integer, colour: [r, g, b]}");
}

const Rule<std::vector<LabelColour>> kLabelColours{"a list of mappings, no two of the same label",
                                                   [](const std::vector<LabelColour>& colours) {
                                                     std::set<int> labels;
                                                     for (const LabelColour& colour : colours)
                                                       labels.insert(colour.label);
                                                     return labels.size() == colours.size();
                                                   }};

}  // namespace

Fields<SurfaceConfig> surface_fields() {
  using S = SurfaceConfig;
  using Shadings = std::vector<std::pair<std::string, Shading>>;
  return {
      field<S>(
          "influence_domain_adaptation", "", true_or_false(),
          [](S & s) -> auto& { return s.influence_domain_adaptation; },
          "Draw the surface exactly on the blade's edge."),
      choice<S>(
          "shading", Shadings{{"flat", Shading::kFlat}, {"smooth", Shading::kSmooth}},
          [](S & s) -> auto& { return s.shading; },
          "Of the markers: triangle by triangle, lit by rviz; or smooth, lit from above in the tissue frame "
          "(1.7 times the data)."),
      field<S>(
          "hidden_labels", "", labels(), [](S & s) -> auto& { return s.hidden_labels; },
          "Labels whose skin and cut faces are left out of the markers."),
      list<S>(
          "label_colours", label_colour_fields(), "[]", kLabelColours,
          [](S & s) -> auto& { return s.label_colours; }, check_label_colour,
          "Colours of labels in the markers, instead of those of skin and cut faces."),
  };
}

}  // namespace cfem_cutting
