#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "metrics/solvation/discrete_surface.h"
#include "metrics/solvation/near_field.h"
#include "metrics/solvation/triangle_integrals.h"
#include "smopt/progress.h"

namespace smopt::metrics {

/// The kernels of close pairs, integrated with the source's shape function over the triangles of its star: a sparse matrix of five numbers an entry.
class CloseMatrix {
 public:
  struct Row {
    std::span<const VertexId> sources;
    std::span<const KernelValues> values;
  };

  /// \param target_of  the i-th of `targets` targets.
  /// \param first      the number of the first target among the points of `near`, of which the first surface.size() are the vertices.
  /// Cost: some 0.05 ms a target for a reach of two edge lengths; all cores.
  CloseMatrix(const NearField& near, const DiscreteSurface& surface, std::size_t first, std::size_t targets,
              const std::function<TargetPoint(std::size_t)>& target_of, const KernelParameters& parameters,
              const TriangleQuadrature& quadrature, const ProgressCallback& progress);

  [[nodiscard]] Row operator[](std::size_t target) const {
    const std::size_t begin = offsets_[target], count = offsets_[target + 1] - begin;
    return {std::span(sources_).subspan(begin, count), std::span(values_).subspan(begin, count)};
  }

 private:
  std::vector<std::size_t> offsets_;
  std::vector<VertexId> sources_;
  std::vector<KernelValues> values_;
};

}  // namespace smopt::metrics
