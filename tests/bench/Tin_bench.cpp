// The triangulation beside CGAL's Constrained_Delaunay_triangulation_2 (exact predicates, inexact
// constructions; Exact_predicates_tag) on the same lattice points, in turns, in one run; prints medians and
// their ratios.
//   bench-tin [ROUNDS [VERTICES]...]
// bulk: all points, sorting included. Local: 200 discs that cover 100 vertices each, and in each 100 random
// points are located, inserted, and removed in another order; the hint is where the operation before was, and
// the first one's is the disc's centre. Random removal: half of all vertices. Ring: 12-gons that cover k
// vertices, 12 vertices and 12 constraints in, then out.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "teren/Hash.h"

#include "generators/tin/Triangulation.h"
#include "tests/bench/Timing.h"

namespace teren {
namespace {

constexpr LatticeFrame kFrame{};
constexpr int kDiscs = 200;
constexpr int kPerDisc = 100;
constexpr int kRings = 100;

/// CGAL's triangulation, as this file uses it.
class Rival {
 public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Default, CGAL::Exact_predicates_tag>;
  using Vertex = Mesh::Vertex_handle;
  using Hint = Mesh::Face_handle;

  static const char* name() { return "cgal"; }
  static Mesh::Point at(LatticePoint p) { return {p.x, p.y}; }

  void bulk(const std::vector<LatticePoint>& points) {
    std::vector<Mesh::Point> copy;
    copy.reserve(points.size());
    for (const LatticePoint p : points) copy.push_back(at(p));
    mesh_.insert(copy.begin(), copy.end());
  }
  /// The vertex of each point.
  std::vector<Vertex> vertices(const std::vector<LatticePoint>& points) {
    std::unordered_map<std::uint64_t, Vertex> known;
    for (auto v = mesh_.finite_vertices_begin(); v != mesh_.finite_vertices_end(); ++v) {
      known[key(static_cast<std::int32_t>(v->point().x()), static_cast<std::int32_t>(v->point().y()))] = v;
    }
    std::vector<Vertex> result;
    for (const LatticePoint p : points) result.push_back(known.at(key(p.x, p.y)));
    return result;
  }
  Hint locate(LatticePoint p, Hint hint) const { return mesh_.locate(at(p), hint); }
  Vertex insert(LatticePoint p, Hint hint) { return mesh_.insert(at(p), hint); }
  Hint hint(Vertex v) const { return v->face(); }
  void remove(Vertex v) { mesh_.remove(v); }
  void constrain(Vertex a, Vertex b) { mesh_.insert_constraint(a, b); }
  void unconstrain(const std::vector<Vertex>& ring) {
    for (Vertex v : ring) mesh_.remove_incident_constraints(v);
  }
  std::size_t count() const { return mesh_.number_of_vertices(); }

 private:
  static std::uint64_t key(std::int32_t x, std::int32_t y) {
    return (std::uint64_t(x) << 32) | std::uint64_t(y);
  }

  Mesh mesh_;
};

/// Ours.
class Own {
 public:
  using Vertex = VertexId;
  using Hint = TriangleId;

  static const char* name() { return "teren"; }

  void bulk(const std::vector<LatticePoint>& points) {
    ids_ = mesh_.insert(points, std::vector<double>(points.size()));
  }
  std::vector<Vertex> vertices(const std::vector<LatticePoint>&) { return ids_; }
  Hint locate(LatticePoint p, Hint hint) const { return mesh_.locate(p, hint).triangle; }
  Vertex insert(LatticePoint p, Hint hint) { return mesh_.insert(p, 0.0, hint).vertex; }
  Hint hint(Vertex v) const { return mesh_.triangleAt(v); }
  void remove(Vertex v) { mesh_.remove(v); }
  void constrain(Vertex a, Vertex b) { mesh_.constrain(a, b, 1); }
  void unconstrain(const std::vector<Vertex>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) mesh_.unconstrain(ring[i], ring[(i + 1) % ring.size()]);
  }
  std::size_t count() const { return mesh_.vertexCount(); }
  double bytesPerVertex() const {
    return static_cast<double>(mesh_.bytes()) / static_cast<double>(mesh_.vertexCount());
  }

 private:
  Triangulation mesh_{kFrame};
  std::vector<VertexId> ids_;
};

/// [ns] of this thread's own work: what others do meanwhile must not count.
double now() {
  return 1e9 * processorSeconds();
}

/// The same points, discs and orders for both, drawn once a size.
struct Workload {
  std::vector<LatticePoint> points;
  std::vector<LatticePoint> centres;
  std::vector<std::vector<LatticePoint>> local;
  std::vector<int> order;                                       // of removal within a disc
  std::vector<std::size_t> half;                                // vertices to remove
  std::map<int, std::vector<std::vector<LatticePoint>>> rings;  // by vertices covered

  explicit Workload(std::size_t n) : random(n) {
    for (VertexId v = 0; v < 4; ++v) points.push_back(Triangulation(kFrame).point(v));
    while (points.size() < n) points.push_back({coordinate(), coordinate()});
    const auto radius = [n](int k) {
      return kFrame.width * std::sqrt(k / (3.141592653589793 * static_cast<double>(n)));
    };
    for (int d = 0; d < kDiscs; ++d) {
      centres.push_back(inside(radius(100)));
      local.emplace_back();
      while (local.back().size() < kPerDisc) {
        const double u = 2 * uniform() - 1, v = 2 * uniform() - 1;
        if (u * u + v * v < 1)
          local.back().push_back(around(centres.back(), radius(100) * u, radius(100) * v));
      }
    }
    for (int i = 0; i < kPerDisc; ++i) order.push_back(i);
    shuffle(order);
    for (std::size_t i = 4; i < n; ++i) half.push_back(i);
    shuffle(half);
    half.resize(n / 2);
    for (const int k : {100, 1000}) {
      for (int r = 0; r < kRings; ++r) {
        const LatticePoint centre = inside(radius(k));
        rings[k].emplace_back();
        for (int i = 0; i < 12; ++i) {
          const double turn = (i + 0.3) / 12 * 6.283185307179586;
          rings[k].back().push_back(around(centre, radius(k) * std::cos(turn), radius(k) * std::sin(turn)));
        }
      }
    }
  }

 private:
  double uniform() { return static_cast<double>(random.nextBits(53)) * 0x1p-53; }
  std::int32_t coordinate() { return static_cast<std::int32_t>(random.nextBits(28)); }
  LatticePoint inside(double margin) {
    const auto along = [&] {
      return static_cast<std::int32_t>(margin + uniform() * (kFrame.width - 2 * margin));
    };
    return {along(), along()};
  }
  static LatticePoint around(LatticePoint p, double x, double y) {
    return {p.x + static_cast<std::int32_t>(x), p.y + static_cast<std::int32_t>(y)};
  }
  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.next() % i]);
  }

  RandomSequence random;
};

using Times = std::map<std::string, std::vector<double>>;  // [ns] an operation, or a ring

/// Discs: nothing of the preparation is timed.
template <class Mesh>
void runLocal(Mesh& mesh, const Workload& work, Times& times) {
  double locating = 0.0, inserting = 0.0, removing = 0.0;
  std::size_t sum = 0;
  typename Mesh::Hint far{};
  for (int d = 0; d < kDiscs; ++d) {
    typename Mesh::Hint hint = mesh.locate(work.centres[d], far);
    far = hint;
    const double start = now();
    for (const LatticePoint p : work.local[d]) hint = mesh.locate(p, hint);
    locating += now() - start;
    sum += hint == far ? 1 : 0;
  }
  std::vector<typename Mesh::Vertex> made(kPerDisc);
  for (int d = 0; d < kDiscs; ++d) {
    typename Mesh::Hint hint = mesh.locate(work.centres[d], typename Mesh::Hint{});
    double start = now();
    for (int i = 0; i < kPerDisc; ++i) {
      made[i] = mesh.insert(work.local[d][i], hint);
      hint = mesh.hint(made[i]);
    }
    inserting += now() - start;
    start = now();
    for (const int i : work.order) mesh.remove(made[i]);
    removing += now() - start;
  }
  if (sum > kDiscs) std::abort();
  times["local locate"].push_back(locating / (kDiscs * kPerDisc));
  times["local insert"].push_back(inserting / (kDiscs * kPerDisc));
  times["local remove"].push_back(removing / (kDiscs * kPerDisc));
}

template <class Mesh>
void runRings(Mesh& mesh, const Workload& work, Times& times) {
  for (const auto& [k, rings] : work.rings) {
    double points = 0.0, constraints = 0.0, out = 0.0;
    for (const std::vector<LatticePoint>& ring : rings) {
      std::vector<typename Mesh::Vertex> made;
      typename Mesh::Hint hint = mesh.locate(ring[0], typename Mesh::Hint{});
      double start = now();
      for (const LatticePoint p : ring) {
        made.push_back(mesh.insert(p, hint));
        hint = mesh.hint(made.back());
      }
      points += now() - start;
      start = now();
      for (std::size_t i = 0; i < made.size(); ++i) mesh.constrain(made[i], made[(i + 1) % made.size()]);
      constraints += now() - start;
      start = now();
      mesh.unconstrain(made);
      for (const auto v : made) mesh.remove(v);
      out += now() - start;
    }
    const std::string name = "ring " + std::to_string(k);
    times[name + " vertices"].push_back(points / kRings);
    times[name + " constraints"].push_back(constraints / kRings);
    times[name + " out"].push_back(out / kRings);
    times[name + " in and out"].push_back((points + constraints + out) / kRings);
  }
}

template <class Mesh>
std::size_t runAll(const Workload& work, Times& times, double& bytesPerVertex) {
  Mesh mesh;
  double start = now();
  mesh.bulk(work.points);
  times["bulk"].push_back((now() - start) / static_cast<double>(work.points.size()));
  if constexpr (requires { mesh.bytesPerVertex(); }) bytesPerVertex = mesh.bytesPerVertex();
  runLocal(mesh, work, times);
  runRings(mesh, work, times);
  const auto vertices = mesh.vertices(work.points);
  start = now();
  for (const std::size_t i : work.half) mesh.remove(vertices[i]);
  times["random remove"].push_back((now() - start) / static_cast<double>(work.half.size()));
  return mesh.count();
}

/// The ratio this project aims at, own time / rival's; 0: none.
double aim(const std::string& what) {
  static const std::map<std::string, double> aims{{"bulk", 0.75},
                                                  {"local insert", 0.7},
                                                  {"local locate", 0.9},
                                                  {"local remove", 0.4},
                                                  {"random remove", 0.5},
                                                  {"ring 100 in and out", 0.5},
                                                  {"ring 1000 in and out", 0.5}};
  const auto found = aims.find(what);
  return found == aims.end() ? 0.0 : found->second;
}

void compare(std::size_t n, int rounds) {
  const Workload work(n);
  Times own, rival;
  double bytes = 0.0;
  for (int round = 0; round < rounds; ++round) {
    const std::size_t theirs = runAll<Rival>(work, rival, bytes);
    const std::size_t ours = runAll<Own>(work, own, bytes);
    if (theirs != ours) std::printf("the two disagree: %zu and %zu vertices are left\n", theirs, ours);
  }
  std::printf("%zu vertices, %d rounds, %.1f bytes a vertex\n", n, rounds, bytes);
  std::printf("  %-24s %12s %12s %8s %8s\n", "ns", Rival::name(), Own::name(), "ratio", "wanted");
  for (const auto& [what, values] : own) {
    const double theirs = median(rival[what]), ours = median(values);
    std::printf("  %-24s %12.1f %12.1f %8.3f", what.c_str(), theirs, ours, ours / theirs);
    aim(what) > 0.0 ? std::printf(" %8.2f\n", aim(what)) : std::printf("\n");
  }
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  std::vector<std::size_t> sizes;
  for (int i = 2; i < argc; ++i) sizes.push_back(std::max(1000UL, std::strtoul(argv[i], nullptr, 10)));
  if (sizes.empty()) sizes = {10000, 100000, 1000000};
  for (const std::size_t n : sizes) teren::compare(n, rounds);
}
