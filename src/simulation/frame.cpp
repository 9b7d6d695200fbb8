#include "simulation/frame.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>

#include "io/digest.hpp"

namespace spindrift {
namespace {

/// A particle of the dense flow or of the cover.
struct Member {
  std::uint64_t id;
  std::uint32_t index;
  bool cover;
};

template <int Dim>
std::vector<Member> members_by_id(const Simulation<Dim>& simulation) {
  std::vector<Member> members;
  if (simulation.dense())
    for (std::uint32_t i = 0; i < simulation.dense()->particles.size(); ++i)
      members.push_back({simulation.dense()->particles.id[i], i, false});
  if (simulation.cover())
    for (std::uint32_t i = 0; i < simulation.cover()->particles.size(); ++i)
      if (simulation.cover()->alive(i)) members.push_back({simulation.cover()->particles.id[i], i, true});
  std::sort(members.begin(), members.end(), [](const Member& a, const Member& b) { return a.id < b.id; });
  return members;
}

/// Calls f(member, its particles) in the order of ids.
template <int Dim, class F>
void for_each_member(const Simulation<Dim>& simulation, const std::vector<Member>& members, F&& f) {
  for (const Member& m : members) f(m, m.cover ? simulation.cover()->particles : simulation.dense()->particles);
}

template <class T, int Dim, class F>
StoredArray array_of(const Simulation<Dim>& simulation, const std::vector<Member>& members, const char* name, F&& f) {
  std::vector<T> values;
  values.reserve(members.size());
  for_each_member(simulation, members,
                  [&](const Member& m, const Particles<Dim>& p) { values.push_back(static_cast<T>(f(m, p))); });
  return {name, 1, std::move(values)};
}

template <class T, int Dim, class F>
StoredArray vectors_of(const Simulation<Dim>& simulation, const std::vector<Member>& members, const char* name, F&& f) {
  std::vector<T> values;
  values.reserve(members.size() * Dim);
  for_each_member(simulation, members, [&](const Member& m, const Particles<Dim>& p) {
    const Vec<Dim> v = f(m, p);
    for (int k = 0; k < Dim; ++k) values.push_back(static_cast<T>(v[k]));
  });
  return {name, Dim, std::move(values)};
}

/// Of the solver's coordinates in those of the scene file [m].
template <int Dim>
Vec<Dim> origin_of(const Simulation<Dim>& simulation) {
  Vec<Dim> origin = Vec<Dim>::Zero();
  if constexpr (Dim == 3) origin = Eigen::Map<const Vec<3>>(simulation.scene().origin.data());
  return origin;
}

/// units: of the arrays that have one, by their names.
template <int Dim>
Attributes attributes_of(const Simulation<Dim>& simulation, std::initializer_list<std::array<const char*, 2>> units) {
  Attributes attributes{{"scene", simulation.scene().scene.name},
                        {"version", std::string(SPINDRIFT_VERSION)},
                        {"seed", static_cast<std::int64_t>(simulation.scene().scene.seed)},
                        {"time", simulation.time()},
                        {"step", static_cast<std::int64_t>(simulation.n_steps())}};
  for (const auto& [array, unit] : units) attributes.push_back({std::string("unit.") + array, std::string(unit)});
  return attributes;
}

std::vector<NamedArray> views(const std::vector<StoredArray>& arrays) {
  std::vector<NamedArray> views;
  for (const StoredArray& array : arrays) views.push_back(array.view());
  return views;
}

}  // namespace

std::vector<std::byte> ParticleFrame::file() const {
  return vtkhdf_bytes(PointCloud{positions.view(), views(arrays), attributes});
}

std::vector<std::byte> SmokeFrame::file() const {
  return vtkhdf_bytes(LatticeImage{lattice, views(arrays), attributes});
}

template <int Dim>
ParticleFrame particle_frame(const Simulation<Dim>& s) {
  const std::vector<Member> members = members_by_id(s);
  const auto in_overlap = [&](const Member& m) {
    return !m.cover && m.index < s.overlap().size() && s.overlap()[m.index];
  };
  ParticleFrame frame;
  frame.attributes = attributes_of(s, {{"Points", "m"},
                                       {"velocity", "m/s"},
                                       {"density", "kg/m^3"},
                                       {"pressure", "Pa"},
                                       {"mass", Dim == 2 ? "kg/m" : "kg"},
                                       {"entrained_at", "s"}});
  const auto place = [](const Member& m, const auto& p) { return p.position[m.index]; };
  const Vec<Dim> origin = origin_of(s);
  const auto far_place = [&](const Member& m, const auto& p) -> Vec<Dim> { return origin + place(m, p); };
  frame.positions = origin.isZero() ? vectors_of<float>(s, members, "Points", place)
                                    : vectors_of<double>(s, members, "Points", far_place);
  frame.arrays.push_back(
      vectors_of<float>(s, members, "velocity", [](const Member& m, const auto& p) { return p.velocity[m.index]; }));
  frame.arrays.push_back(array_of<float>(
      s, members, "density", [](const Member& m, const auto& p) { return p.mass[m.index] / p.volume[m.index]; }));
  frame.arrays.push_back(
      array_of<float>(s, members, "pressure", [](const Member& m, const auto& p) { return p.pressure[m.index]; }));
  frame.arrays.push_back(
      array_of<float>(s, members, "mass", [](const Member& m, const auto& p) { return p.mass[m.index]; }));
  frame.arrays.push_back(array_of<float>(s, members, "entrained_at",
                                         [](const Member& m, const auto& p) { return p.entrained_at[m.index]; }));
  frame.arrays.push_back(
      array_of<std::uint8_t>(s, members, "layer", [](const Member& m, const auto&) { return m.cover; }));
  frame.arrays.push_back(
      array_of<std::uint8_t>(s, members, "overlap", [&](const Member& m, const auto&) { return in_overlap(m); }));
  frame.arrays.push_back(array_of<std::int64_t>(s, members, "id", [](const Member& m, const auto&) { return m.id; }));
  return frame;
}

template <int Dim>
SmokeFrame smoke_frame(const Simulation<Dim>& s) {
  const Suspension<Dim>& suspension = *s.suspension();
  const MacGrid<Dim>& grid = suspension.grid();
  const std::size_t n = count<Dim>(grid.cells);
  std::vector<float> density(n), velocity(n * Dim);
  std::vector<std::uint8_t> solid(n);
  std::size_t cell = 0;
  for_each_index<Dim>(grid.cells, [&](const Index<Dim>& i) {
    solid[cell] = suspension.ground().volume()[cell] == 0;
    density[cell] = solid[cell] ? 0 : static_cast<float>(suspension.smoke_density(cell));
    for (int axis = 0; axis < Dim; ++axis) {
      const auto& u = suspension.velocity()[axis];
      velocity[cell * Dim + static_cast<std::size_t>(axis)] =
          solid[cell] ? 0 : static_cast<float>(0.5 * (u[i] + u[shifted<Dim>(i, axis, 1)]));
    }
    ++cell;
  });
  SmokeFrame frame;
  const Vec<Dim> first = grid.cell_centre(Index<Dim>{}) + origin_of(s);
  frame.lattice.shape = {grid.cells[0], Dim == 3 ? grid.cells[1] : 1, grid.cells[Dim - 1]};
  frame.lattice.origin = {first[0], Dim == 3 ? first[1] : 0, first[Dim - 1]};
  frame.lattice.spacing = {grid.dx, Dim == 3 ? grid.dx : 1, grid.dx};
  frame.arrays.push_back({"density", 1, std::move(density)});
  frame.arrays.push_back({"velocity", Dim, std::move(velocity)});
  frame.arrays.push_back({"solid", 1, std::move(solid)});
  frame.attributes = attributes_of(s, {{"density", "kg/m^3"}, {"velocity", "m/s"}});
  return frame;
}

template <int Dim>
std::string state_digest(const Simulation<Dim>& s) {
  Digest digest;
  digest.add(s.time()).add(s.n_steps());
  for_each_member(s, members_by_id(s), [&](const Member& m, const Particles<Dim>& p) {
    digest.add(p.id[m.index]).add(static_cast<std::uint8_t>(m.cover));
    digest.add(std::span<const double>(p.position[m.index].data(), Dim));
    digest.add(std::span<const double>(p.velocity[m.index].data(), Dim));
    digest.add(p.mass[m.index]).add(p.volume[m.index]).add(p.pressure[m.index]);
    digest.add(p.entrained_at[m.index]);
    if (m.cover) digest.add(s.cover()->hazard[m.index]);
  });
  if (s.suspension()) {
    const Field<Dim> pressure = s.suspension()->pressure();
    for (const auto& u : s.suspension()->velocity()) digest.add(u.values());
    digest.add(s.suspension()->smoke_mass().values());
    digest.add(pressure.values());
  }
  return digest.hex();
}

#define INSTANTIATE(Dim)                                              \
  template ParticleFrame particle_frame<Dim>(const Simulation<Dim>&); \
  template SmokeFrame smoke_frame<Dim>(const Simulation<Dim>&);       \
  template std::string state_digest<Dim>(const Simulation<Dim>&);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace spindrift
