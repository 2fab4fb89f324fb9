#include "cfem_cutting/io/config_reader.h"
#include "cfem_cutting/io/replay.h"

namespace cfem_cutting {
namespace {

std::string cell(const std::string& text, bool code = false) {
  if (text.empty()) return " |";
  return code ? " `" + text + "` |" : " " + text + " |";
}

}  // namespace

std::string parameters_markdown() {
  std::string text =
      "# Parameters\n\n"
      "All keys of a configuration, for the node (private parameters) and for `replay` (a YAML file) alike. "
      "Units are "
      "SI. Unknown keys, wrong types and values out of range are refused. Numbers may be integers, reals or "
      "numeric "
      "strings such as `1e-4`. This page is printed by `rosrun cfem_cutting replay --list-parameters`.\n\n"
      "| key | default | unit | must be | meaning |\n"
      "|---|---|---|---|---|\n";
  for (const KeyDoc& key : schema())
    text += "|" + cell(key.key, true) + cell(key.default_value, true) + cell(key.unit) + cell(key.rule) +
            cell(key.description) + "\n";
  return text;
}

}  // namespace cfem_cutting
