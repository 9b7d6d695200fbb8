#include "simulation/registry_rows.hpp"

namespace spindrift {

void add_setting(Registry& r) {
  using S = SceneSection;
  Rows<&Scene::scene>(r, "scene", "what the run is called and how long it lasts")
      .plain<&S::name>("name", "of the run folder and the pictures; default: the file's name")
      .number<&S::dim>("dim", "", from(2, 3), "2: a slice one metre wide, x and z; 3: x, y and z")
      .number<&S::seed>("seed", "", from(0, 9223372036854775807.0), "of all random numbers")
      .words<&S::preset>("preset", {"physical", "paper"},
                         "which defaults hold: measured snow, or the paper's constants")
      .number<&S::end_time>("end_time", "s", above(0, 1e6), "simulated time at which the run ends")
      .number<&S::max_step>("max_step", "s", above(0, 10), "longest time step, whatever else allows more");

  using D = DomainSection;
  const std::vector<std::string_view> side = {"open", "closed"};
  Rows<&Scene::domain>(r, "domain", "the box in which everything happens; the last axis points up")
      .number<&D::lower>("lower", "m", position, "lower corner")
      .number<&D::upper>("upper", "m", position, "upper corner")
      .number<&D::gravity>("gravity", "m/s^2", speed, "default: 9.81 downwards; tilt it to lay a box along a slope")
      .words<&D::left>("left", side, "side of least x: snow and air leave, or meet a wall")
      .words<&D::right>("right", side, "side of greatest x")
      .words<&D::bottom>("bottom", side, "side of least z")
      .words<&D::top>("top", side, "side of greatest z")
      .words<&D::front>("front", side, "side of least y (3D)")
      .words<&D::back>("back", side, "side of greatest y (3D)");

  using T = TerrainSection;
  std::vector<std::string_view> shapes = {"slope", "bumps", "cliff", "polyline"};
  shapes.insert(shapes.end(), field_shapes.begin(), field_shapes.end());
  Rows<&Scene::terrain>(r, "terrain", "the ground")
      .words<&T::shape>("shape", shapes, "kind of ground; from plane on in 3D only", "Figs. 9, 12, 13")
      .with("shape", {"slope", "bumps", "cliff", "plane", "parabola", "bowl", "helix", "ridge", "cliff_band", "valley"})
      .number<&T::start>("start", "m", position,
                         "upper left end of the slope (x, z), in 3D in the middle of the domain's breadth")
      .number<&T::angle>("angle", "rad", below(0, right_angle), "of the slope, downhill to the right")
      .with("shape", {"slope", "bumps", "cliff", "parabola", "bowl", "helix", "ridge", "cliff_band"})
      .number<&T::drop>("drop", "m", extent, "height of the whole slope from start to its foot")
      .with("shape", {"slope", "bumps", "cliff", "ridge", "cliff_band"})
      .number<&T::runout_angle>("runout_angle", "rad", between(-right_angle, right_angle),
                                "of the ground beyond the foot")
      .with("shape", {"slope", "bumps", "cliff", "ridge", "cliff_band", "valley"})
      .number<&T::transition_radius>("transition_radius", "m", from(0, 1e5),
                                     "of the arc between slope and run-out, or between a valley's floor and its walls")
      .with("shape", {"bumps"})
      .number<&T::bump_height>("bump_height", "m", from(0, 1000), "crest to trough")
      .number<&T::bump_length>("bump_length", "m", extent, "wavelength along the slope")
      .with("shape", {"cliff", "cliff_band"})
      .number<&T::cliff_at>("cliff_at", "m", extent, "drop from start at which the cliff begins")
      .number<&T::cliff_height>("cliff_height", "m", extent, "height of the cliff")
      .with("shape", {"cliff_band"})
      .number<&T::cliff_angle>("cliff_angle", "rad", between(0, right_angle), "of the band, where it is steepest")
      .with("shape", {"plane"})
      .number<&T::side_angle>("side_angle", "rad", between(-right_angle, right_angle), "by which it falls along y")
      .with("shape", {"helix"})
      .number<&T::bend_radius>("bend_radius", "m", extent,
                               "of the channel's middle, which sets out along x and turns towards y")
      .number<&T::channel_depth>("channel_depth", "m", from(0, 1000), "of the channel")
      .number<&T::channel_width>("channel_width", "m", extent, "of the channel between its edges")
      .with("shape", {"ridge"})
      .words<&T::ridge_runs>("ridge_runs", {"across", "along"}, "across the slope, or along its middle")
      .number<&T::ridge_at>("ridge_at", "m", from(0, 1e5), "x of the crest from start on, where it runs across")
      .number<&T::ridge_height>("ridge_height", "m", from(0, 1000), "of the crest over the slope")
      .number<&T::ridge_width>("ridge_width", "m", extent, "of the Gaussian: from the crest to 0.61 of its height")
      .with("shape", {"valley"})
      .number<&T::floor_width>("floor_width", "m", from(0, 1e5), "of the level floor between the walls")
      .number<&T::wall_angle>("wall_angle", "rad", between(0, right_angle), "towards which the walls rise")
      .with("shape", {"plane", "parabola", "bowl", "helix", "ridge", "cliff_band", "valley"})
      .number<&T::cell_size>("cell_size", "m", above(0, 1e4), "of the grid on which the shape is sampled")
      .with("shape", {"polyline"})
      .number<&T::points>("points", "m", position, "vertices (x, z) from left to right")
      .with("shape", {"polyline", "grid"})
      .plain<&T::file>(
          "file",
          "polyline: text file of such vertices, one \"x z\" in metres a line; grid: elevation model as an "
          "ESRI ASCII grid or, with GDAL, a GeoTIFF; its path is seen from the scene file")
      .always()
      .plain<&T::avaframe>("avaframe",
                           "folder of AvaFrame that has an elevation model, areas of release in `REL`, of the cover in "
                           "`ENT`, and perhaps a path in `LINES`; makes shape grid");

  using B = ObstacleSection;
  Rows<&Scene::obstacle>(r, "obstacle", "something solid, for snow and air; there may be several")
      .words<&B::shape>("shape", {"box", "area"}, "box; area: 3D ground raised under a polygon seen from above")
      .with("shape", {"box"})
      .number<&B::lower>("lower", "m", position, "lower corner")
      .number<&B::upper>("upper", "m", position, "upper corner")
      .with("shape", {"area"})
      .number<&B::points>("points", "m", position, "corners (x, y) one after the other")
      .plain<&B::file>("file", "in place of points: a shapefile or another map of polygons, an obstacle each")
      .number<&B::height>("height", "m", above(0, 1000),
                          "above the ground; its walls are as sharp as the ground's cells");
}

}  // namespace spindrift
