#include "element_product.h"

#include <algorithm>
#include <unordered_map>

#include "element_kernel.h"

namespace cfem_cutting {
namespace {

constexpr int kMatrix = 24 * 24;
constexpr int kEntries = 24 * kLanes;      // of a batch in Packed::y
constexpr int kElementsPerThread = 2048;   // fewer are not worth waking a thread
constexpr int kFewestShared = kLanes / 2;  // elements that make a batch with one matrix worthwhile

/// Elements by matrix, in the order of first occurrence.
std::vector<std::vector<int>> group_by_matrix(const ElasticModel& model) {
  std::vector<std::vector<int>> groups;
  std::unordered_map<const ElementMatrix*, std::size_t> group_of_matrix;
  for (int e = 0; e < static_cast<int>(model.mesh().elements().size()); ++e) {
    const auto [it, added] = group_of_matrix.try_emplace(&model.stiffness(e), groups.size());
    if (added) groups.emplace_back();
    groups[it->second].push_back(e);
  }
  return groups;
}

}  // namespace

void ElementProduct::set(const ElasticModel& model, std::vector<Mat3> rotations, Precision precision) {
  if (version_ != model.version()) arrange(model);
  rotations_ = std::move(rotations);
  if (precision == Precision::kSingle) {
    if (single_.version != version_) pack_stiffness(model, single_);
    pack_rotations(single_);
  } else {
    if (double_.version != version_) pack_stiffness(model, double_);
    pack_rotations(double_);
  }
}

void ElementProduct::apply(const NodeField& p, NodeField& y, Precision precision) const {
  if (precision == Precision::kSingle) {
    multiply_batches(p, y, single_);
  } else {
    multiply_batches(p, y, double_);
  }
}

std::vector<Mat3> ElementProduct::diagonal_blocks(const ElasticModel& model) const {
  std::vector<Mat3> blocks(first_slot_.size() - 1, Mat3::Zero());
  pool_.for_range(static_cast<int>(blocks.size()), kElementsPerThread, [&](int begin, int end) {
    for (int node = begin; node < end; ++node) {
      for (int s = first_slot_[node]; s < first_slot_[node + 1]; ++s) {
        const int e = element_corner_of_slot_[s] / 8, n = element_corner_of_slot_[s] % 8;
        blocks[node] +=
            rotations_[e] * model.stiffness(e).block<3, 3>(3 * n, 3 * n) * rotations_[e].transpose();
      }
    }
  });
  return blocks;
}

void ElementProduct::arrange(const ElasticModel& model) {
  version_ = model.version();
  batches_.clear();
  element_of_lane_.clear();
  nodes_.clear();
  stiffness_count_ = 0;
  std::vector<int> others;
  for (const std::vector<int>& group : group_by_matrix(model)) {
    if (static_cast<int>(group.size()) >= kFewestShared) {
      add_batches(group, true);
    } else {
      others.insert(others.end(), group.begin(), group.end());
    }
  }
  std::sort(others.begin(), others.end());
  add_batches(others, false);
  connect_nodes(model.mesh());
}

void ElementProduct::add_batches(const std::vector<int>& elements, bool shared) {
  const std::size_t matrix = stiffness_count_;
  if (shared) stiffness_count_ += kMatrix;
  for (std::size_t first = 0; first < elements.size(); first += kLanes) {
    const int count = static_cast<int>(std::min<std::size_t>(kLanes, elements.size() - first));
    batches_.push_back(
        {static_cast<int>(element_of_lane_.size()), count, shared, shared ? matrix : stiffness_count_});
    if (!shared) stiffness_count_ += kMatrix * kLanes;
    element_of_lane_.insert(element_of_lane_.end(), elements.begin() + first,
                            elements.begin() + first + count);
  }
}

void ElementProduct::connect_nodes(const CompositeMesh& mesh) {
  nodes_.assign(batches_.size() * 8 * kLanes, 0);
  std::vector<int> base_of_element(mesh.elements().size());
  for (std::size_t b = 0; b < batches_.size(); ++b) {
    for (int lane = 0; lane < batches_[b].count; ++lane) {
      const int e = element_of_lane_[batches_[b].first + lane];
      base_of_element[e] = static_cast<int>(b) * kEntries + lane;
      for (int n = 0; n < 8; ++n) nodes_[(b * 8 + n) * kLanes + lane] = mesh.elements()[e].nodes[n];
    }
  }
  first_slot_.assign(mesh.node_count() + 1, 0);
  for (const CompositeElement& element : mesh.elements())
    for (int node : element.nodes) ++first_slot_[node + 1];
  for (int node = 0; node < mesh.node_count(); ++node) first_slot_[node + 1] += first_slot_[node];
  std::vector<int> next(first_slot_.begin(), first_slot_.end() - 1);
  slots_.resize(8 * mesh.elements().size());
  element_corner_of_slot_.resize(slots_.size());
  for (int e = 0; e < static_cast<int>(mesh.elements().size()); ++e) {
    for (int n = 0; n < 8; ++n) {
      const int slot = next[mesh.elements()[e].nodes[n]]++;
      slots_[slot] = base_of_element[e] + 3 * n * kLanes;
      element_corner_of_slot_[slot] = 8 * e + n;
    }
  }
}

template <typename Scalar>
void ElementProduct::pack_stiffness(const ElasticModel& model, Packed<Scalar>& packed) const {
  packed.version = version_;
  packed.stiffness.assign(stiffness_count_, Scalar{0});
  for (const Batch& batch : batches_) {
    Scalar* out = packed.stiffness.data() + batch.stiffness;
    const int lanes = batch.shared ? 1 : batch.count;
    for (int lane = 0; lane < lanes; ++lane) {
      const double* K = model.stiffness(element_of_lane_[batch.first + lane]).data();
      const int stride = batch.shared ? 1 : kLanes;
      for (int i = 0; i < kMatrix; ++i) out[i * stride + lane] = static_cast<Scalar>(K[i]);
    }
  }
  packed.x.resize(3 * (first_slot_.size() - 1));
  packed.y.resize(batches_.size() * kEntries);
  packed.rotations.assign(batches_.size() * 9 * kLanes, Scalar{0});
}

template <typename Scalar>
void ElementProduct::pack_rotations(Packed<Scalar>& packed) const {
  for (std::size_t b = 0; b < batches_.size(); ++b) {
    for (int lane = 0; lane < batches_[b].count; ++lane) {
      const Mat3& R = rotations_[element_of_lane_[batches_[b].first + lane]];
      for (int i = 0; i < 9; ++i)
        packed.rotations[(b * 9 + i) * kLanes + lane] = static_cast<Scalar>(R(i / 3, i % 3));
    }
  }
}

template <typename Scalar>
void ElementProduct::multiply_batches(const NodeField& p, NodeField& y, const Packed<Scalar>& packed) const {
  Eigen::Map<Eigen::Array<Scalar, Eigen::Dynamic, 1>>(packed.x.data(), packed.x.size()) =
      Eigen::Map<const Eigen::ArrayXd>(p.data(), p.size()).template cast<Scalar>();
  pool_.for_range(static_cast<int>(batches_.size()), kElementsPerThread / kLanes, [&](int begin, int end) {
    for (int b = begin; b < end; ++b) {
      multiply({packed.stiffness.data() + batches_[b].stiffness, batches_[b].shared,
                packed.rotations.data() + std::size_t(b) * 9 * kLanes,
                nodes_.data() + std::size_t(b) * 8 * kLanes, packed.x.data(),
                packed.y.data() + std::size_t(b) * kEntries});
    }
  });
  y.resize(3, p.cols());
  pool_.for_range(static_cast<int>(p.cols()), kElementsPerThread, [&](int begin, int end) {
    for (int node = begin; node < end; ++node) {
      Vec3 sum = Vec3::Zero();
      for (int s = first_slot_[node]; s < first_slot_[node + 1]; ++s) {
        const Scalar* entry = packed.y.data() + slots_[s];
        sum += Vec3(entry[0], entry[kLanes], entry[2 * kLanes]);
      }
      y.col(node) = sum;
    }
  });
}

}  // namespace cfem_cutting
