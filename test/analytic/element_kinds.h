#pragma once

#include <ostream>
#include <string>

#include "cfem_cutting/elasticity/elastic_model.h"

namespace cfem_cutting {

inline std::string name_of(ElementKind kind) {
  return kind == ElementKind::kTrilinear ? "trilinear" : "incompatible modes";
}

/// For the names of tests.
inline void PrintTo(ElementKind kind, std::ostream* stream) { *stream << name_of(kind); }

}  // namespace cfem_cutting
