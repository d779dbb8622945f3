#include <smopt/improve/improve.h>
#include <smopt/io/mesh_io.h>

#include <iostream>

int main(int argc, char** argv) try {
  if (argc != 3) throw smopt::InvalidOption("usage: example IN OUT");
  smopt::TriangleMesh mesh = smopt::read_mesh(argv[1]);

  const auto progress = [](std::string_view stage, double fraction) {
    std::cerr << stage << ": " << static_cast<int>(100 * fraction) << " %\n";
    return true;  // false cancels
  };
  const smopt::SmoothingReport smoothing = smopt::improve(mesh, smopt::ImproveOptions{}, progress).smoothing;

  std::cout << smoothing.moves.accepted << " accepted, " << smoothing.moves.refused
            << " refused, stopped because: " << smoothing.stopped_because << '\n';
  smopt::write_mesh(argv[2], mesh);
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
