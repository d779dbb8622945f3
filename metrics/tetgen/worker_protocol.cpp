#include "metrics/tetgen/worker_protocol.h"

#include <cstring>
#include <fstream>
#include <sstream>
#include <type_traits>

#include "smopt/error.h"

namespace smopt::metrics::worker {
namespace {

/// First bytes of the two files; the digit is the version of the layout.
constexpr std::string_view kTaskMagic = "SMOPT-TASK-1";
constexpr std::string_view kAnswerMagic = "SMOPT-ANSW-1";
constexpr int kStillAtWork = -1;

class Writer {
 public:
  explicit Writer(std::string_view magic) : bytes_(magic) {}

  template <class T>
  void value(const T& x) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&x), sizeof(T));
  }
  void text(const std::string& s) {
    value(s.size());
    bytes_ += s;
  }
  void points(const std::vector<Vec3>& points) {
    value(points.size());
    for (const Vec3& p : points)
      for (const double x : p) value(x);
  }
  template <class T>
  void array(const std::vector<T>& items) {
    value(items.size());
    for (const T& item : items) value(item);
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  Reader(const std::string& bytes, std::string_view magic) : bytes_(bytes), at_(magic.size()) {
    if (!bytes.starts_with(magic)) throw InvalidInput("the TetGen worker's file does not begin as it should");
  }

  template <class T>
  T value() {
    T x;
    std::memcpy(&x, next(sizeof(T)), sizeof(T));
    return x;
  }
  std::string text() {
    const auto size = value<std::size_t>();
    const char* begin = next(size);
    return {begin, begin + size};
  }
  std::vector<Vec3> points() {
    std::vector<Vec3> points(count_of(3 * sizeof(double)));
    for (Vec3& p : points)
      for (double& x : p) x = value<double>();
    return points;
  }
  template <class T>
  std::vector<T> array() {
    std::vector<T> items(count_of(sizeof(T)));
    for (T& item : items) item = value<T>();
    return items;
  }

 private:
  const char* next(std::size_t size) {
    if (size > bytes_.size() - at_) throw InvalidInput("the TetGen worker's file is truncated");
    const char* begin = bytes_.data() + at_;
    at_ += size;
    return begin;
  }
  std::size_t count_of(std::size_t item_size) {
    const auto count = value<std::size_t>();
    if (count > (bytes_.size() - at_) / item_size) throw InvalidInput("the TetGen worker's file is truncated");
    return count;
  }

  const std::string& bytes_;
  std::size_t at_;
};

}  // namespace

std::string encode(const Task& task) {
  Writer out(kTaskMagic);
  out.text(task.switches);
  out.points(task.surface.points);
  out.array(task.surface.triangles);
  return out.take();
}

Task decode_task(const std::string& bytes) {
  Reader in(bytes, kTaskMagic);
  Task task;
  task.switches = in.text();
  task.surface.points = in.points();
  task.surface.triangles = in.array<Triangle>();
  return task;
}

std::string encode(const Answer& answer) {
  Writer out(kAnswerMagic);
  out.value(answer.code.value_or(kStillAtWork));
  out.text(answer.tetgen_version);
  out.value(answer.peak_memory_mb);
  out.points(answer.mesh.points);
  out.array(answer.mesh.tetrahedra);
  out.array(answer.mesh.boundary_faces);
  out.array(answer.mesh.surface_triangle);
  return out.take();
}

Answer decode_answer(const std::string& bytes) {
  Reader in(bytes, kAnswerMagic);
  Answer answer;
  if (const int code = in.value<int>(); code != kStillAtWork) answer.code = code;
  answer.tetgen_version = in.text();
  answer.peak_memory_mb = in.value<double>();
  answer.mesh.points = in.points();
  answer.mesh.tetrahedra = in.array<std::array<VertexId, 4>>();
  answer.mesh.boundary_faces = in.array<Triangle>();
  answer.mesh.surface_triangle = in.array<FaceId>();
  return answer;
}

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  if (!file || !(content << file.rdbuf())) throw InvalidInput("cannot read " + path.string());
  return std::move(content).str();
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  if (!file.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush()) throw InvalidInput("cannot write " + path.string());
}

}  // namespace smopt::metrics::worker
