#include <algorithm>
#include <numeric>

#include "field.h"

namespace cfem_cutting {
namespace {

/// Insertions, deletions and replacements that lead from one word to the other (Levenshtein 1966).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }

}  // namespace

std::string suggestion(const std::string& key, const std::vector<std::string>& known) {
  const std::size_t most = std::max<std::size_t>(2, last_part(key).size() / 3);
  std::size_t best = most + 1;
  std::string nearest;
  for (const std::string& candidate : known) {
    const bool misplaced = last_part(candidate) == last_part(key);
    const bool shortened = candidate.compare(0, key.size(), key) == 0;
    const std::size_t distance = misplaced || shortened ? 1 : edit_distance(key, candidate);
    if (distance < best) best = distance, nearest = candidate;
  }
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

}  // namespace cfem_cutting
