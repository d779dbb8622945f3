#pragma once

#include <filesystem>

#include "experiments/record.h"
#include "smopt/mesh/triangle_mesh.h"

/// A run's folder, made by hand.
namespace smopt::testing {

void save_record(const std::filesystem::path& run, const experiments::Json& record);
void save_mesh(const std::filesystem::path& run, const std::string& molecule, const std::string& method, const TriangleMesh& mesh);

/// A reason that would end a script element and start another, if it were taken for markup.
inline constexpr const char* kMarkupReason = R"(gave "</script><script>window.broken = true</script><img src=x onerror=alert(1)>" & ended)";

/// Two molecules, "ball" and "ring", with the cases initial, smopt, laplacian and meshlab. The ball's smopt mesh is smooth and its laplacian
/// mesh cuts another ball; the ring's laplacian case failed of `kMarkupReason`, and its meshlab case diverged.
void make_run(const std::filesystem::path& run);

}  // namespace smopt::testing
