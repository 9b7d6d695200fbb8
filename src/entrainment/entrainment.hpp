#pragma once
/// Entrainment of the cover by the dense flow (paper Sec. 4.4.2).

#include <cstdint>
#include <span>
#include <vector>

#include "entrainment/shared_traction.hpp"
#include "entrainment/strain_rate.hpp"
#include "sph/columns.hpp"
#include "sph/cover.hpp"
#include "sph/particles.hpp"

namespace spindrift {

enum class EntrainmentRule {
  clock,      ///< exposed particles only, a flux of Er whatever the packing, exact in dt (R15)
  bernoulli,  ///< Eq. (16) literally: every particle that fails, a draw a step, the area of a disc
};

/// The snow that weighs on a cover particle.
enum class OverburdenColumn {
  normal,    ///< along the normal of the ground: W
  vertical,  ///< along gravity, Fig. 8: W / cos(theta), exact on a plane; cos(theta) floored at 0.1
};

struct EntrainmentOptions {
  EntrainmentRule rule = EntrainmentRule::clock;
  double rate = 10;              ///< Er [kg m^-2 s^-1]
  FailureThreshold threshold{};  ///< gamma_0 [s^-1]
  OverburdenColumn column = OverburdenColumn::normal;
  bool spontaneous = false;    ///< the cover may fail with no moving snow on it; then all of it is looked at
  double friction_factor = 1;  ///< on gamma_f = tau_f / eta
  double least_speed = 0.1;    ///< of dense snow that counts as moving [m s^-1]
};

/// When and under which random numbers a step takes place.
struct EntrainmentStep {
  double time = 0;  ///< written to entrained_at [s]
  double dt = 0;    ///< [s]
  std::uint64_t seed = 1;
  std::uint32_t number = 0;  ///< of the step; only the Bernoulli rule draws anew each step
};

template <int Dim>
class Entrainment {
 public:
  explicit Entrainment(const EntrainmentOptions& options) : options_(options) {}

  /// Moves failing cover particles out of the cover. A particle fails while gamma_i > gamma_0, Eqs. (14) and (15), and
  /// moving dense snow is within 1.5 d of it (R13). By the clock rule, of these only the exposed ones - no cover within
  /// 1.5 d inside 45 degrees of the normal - and the topmost of each ground bin are candidates, at the rate
  ///   lambda = Er A / (sum of m over the candidates of the bin),  A the bin's ground, (2 d)^(Dim-1) on a profile;
  /// a particle goes once the integral of lambda dt passes its own unit-exponential number, a function of seed and id.
  /// Within the step lambda rises as candidates go, so that the flux is Er as long as the step leaves a candidate: low
  /// by at most Er A dt / 2 m. (Without the topmost, bins whose pit the neighbours' cover overhangs stand still, and
  /// the flux is 0.86 Er.)
  /// By the Bernoulli rule each goes with probability P_e = Er S dt / m, Eq. (16); S = 2 r or pi r^2.
  /// cover     inout: slots become dead, hazards grow; slots may be renumbered (compact_cover)
  /// dense     in
  /// columns   in: of these particles in this order, with the friction impulse J of this step, which is the traction
  ///           tau_f = |J| / (A dt) on the bed; positions up to a step old will do
  /// gravity   g [m s^-2]
  /// Returns the entrained particles by id, at rest, mass and volume kept (R16, R20): to be appended to the dense flow.
  /// Source: paper Sec. 4.4.2, Eqs. (14)-(16).  Departure: R12-R16.
  const Particles<Dim>& take(Cover<Dim>& cover, const Particles<Dim>& dense, const Columns<Dim>& columns,
                             const Vec<Dim>& gravity, const EntrainmentStep& step);

  /// Of the last take(): sum of m [kg].
  double mass_taken() const { return mass_taken_; }
  /// Of the last take(): the mean flux that the rule stands for, of each bin with candidates.
  std::span<const BedFlux<Dim>> fluxes() const { return fluxes_; }
  const EntrainmentOptions& options() const { return options_; }
  /// What the last take() returned.
  const Particles<Dim>& taken() const { return entrained_; }
  std::size_t bytes() const {
    return entrained_.bytes() + spindrift::bytes(patches_) + spindrift::bytes(candidates_, taken_) +
           spindrift::bytes(bins_taken_) + spindrift::bytes(fluxes_);
  }

 private:
  /// A ground bin with cover that may fail, and its candidates in candidates_.
  struct Patch {
    GroundBin<Dim> bin{};
    double area = 0;  ///< A, of its ground [m^(Dim-1)]
    std::uint32_t first = 0, end = 0;
  };
  struct View;

  void find_patches(const Cover<Dim>& cover, const Columns<Dim>& columns);
  void find_candidates(Patch& patch, const View& view);
  void run_clocks(const Patch& patch, Cover<Dim>& cover, const EntrainmentStep& step) const;
  double flux(const Patch& patch, const Cover<Dim>& cover) const;
  void draw(const Patch& patch, Cover<Dim>& cover, const EntrainmentStep& step) const;

  EntrainmentOptions options_;
  Particles<Dim> entrained_;
  double mass_taken_ = 0;
  std::vector<Patch> patches_;
  std::vector<std::uint32_t> candidates_, taken_;  ///< slots of the cover
  std::vector<GroundBin<Dim>> bins_taken_;
  std::vector<BedFlux<Dim>> fluxes_;
};

}  // namespace spindrift
