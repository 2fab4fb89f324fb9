#pragma once

namespace cfem_cutting {

/// Seconds per element of a plain element product: single precision, 16 lanes a batch, one shared 24 × 24
/// matrix, gather, rotate, multiply, rotate back and scatter on a grid of 32³ elements. The unit in which
/// other times are told, measured anew in every call, for machines that are not always equally fast.
double yardstick();

}  // namespace cfem_cutting
