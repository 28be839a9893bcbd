// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/run.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/lanes/instruction_set.hpp>
#include <tangency/dem/parallel.hpp>
#include <tangency/dem/profile.hpp>
#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/tool/advice.hpp>
#include <tangency/dem/tool/body_table.hpp>
#include <tangency/dem/tool/check.hpp>
#include <tangency/dem/tool/results.hpp>
#include <tangency/dem/verification.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/dem/work_done.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/geometry/tables/progress.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Above it the motion is no longer slow, and the stresses are not those of a sound run: measured
/// on shear tests of one sample at growing strain rates.
constexpr double kSoundInertialFraction = 0.015;

/// Of the cycles of a stage, those in which a held stress may be off by more than kHeldWithin; and
/// how far it may be off in any. Chosen: a servo passes its stress once when it arrives there.
constexpr double kSoundMissedShare = 0.01;
constexpr double kSoundMiss = 0.05;

/// Of the time step over the critical one, which is a bound for contacts that all stick and swing
/// against each other. Measured on growth-1000 (tests/dem/shear_study.cpp): at 1.08 a halved step
/// moves the peak friction angle by 0.01 degrees; at 1.18 particles swing, at 1.6 the peak is gone.
constexpr double kSoundTimeStepRatio = 1.1;

/// Of the error of the energy account over what went through it. Measured: 2e-3 and less in sound
/// runs, 4 and more where the step is half as long again as allowed.
constexpr double kSoundEnergyError = 0.02;

volatile std::sig_atomic_t caught_signal = 0;

extern "C" void catch_signal(int number) { caught_signal = number; }

double mean_radius(const Scene& scene) {
  double sum = 0.0;
  for (const Batch& batch : scene.batches())
    sum += static_cast<double>(batch.count) * batch.shape.mean_radius;
  return sum / static_cast<double>(scene.particle_count());
}

/// Adds the time of its scope to a sum, whether or not the scope ends by an exception.
class AddedSeconds {
 public:
  explicit AddedSeconds(double& sum) : sum_(sum) {}
  ~AddedSeconds() { sum_ += seconds_since(start_); }
  AddedSeconds(const AddedSeconds&) = delete;
  AddedSeconds& operator=(const AddedSeconds&) = delete;

 private:
  double& sum_;
  Clock::time_point start_ = Clock::now();
};

std::string short_text(double x) { return tables::rounded_text(x, 3); }

class Run {
 public:
  /// @param verification  that has checked the simulation as it is; null: nothing is checked
  Run(Simulation simulation, const RunOptions& options, Verification* verification)
      : simulation_(std::move(simulation)),
        verification_(verification),
        out_(options.out),
        quiet_(options.quiet),
        results_(options, simulation_),
        progress_(options.quiet ? tables::Progress::Shown::nothing
                                : tables::Progress::Shown::everywhere) {
    cost_.threads = threads();
    cost_.settings = options.settings;
    if (options.profile) simulation_.record(&cost_.profile.emplace());
    work_.note(simulation_.state().energy);
  }

  int execute() {
    if (const std::string& changed = simulation_.changed_laws(); !changed.empty())
      warn("goes on under other contact laws: the state was made with " + changed);
    if (const std::string& changed = simulation_.changed_walls(); !changed.empty())
      warn("goes on with other walls: the state was made with " + changed);
    if (!quiet_) warn_by_check();
    for (const double strain : results_.kept().missed_strains())
      warn("stage " + simulation_.stage().name + " passed the axial strain " +
           tables::to_text(strain) + " of save_strains before cycle " +
           std::to_string(simulation_.state().cycle) + ": its state is not kept");
    // A run that is over would leave no row in a directory of its own.
    if (!results_.has_rows() && (simulation_.state().cycle == 0 || simulation_.finished())) {
      results_.add_row(simulation_);
      if (simulation_.scene().output.micro > 0) results_.add_micro(simulation_);
    }
    if (simulation_.state().cycle == 0) {
      results_.add_frame(simulation_);
      results_.add_contacts(simulation_);
    }
    try {
      results_.make_up(simulation_);
      results_.kept().begin(simulation_);
      while (!simulation_.finished()) {
        const StageStatus status = simulation_.status();
        if (status == StageStatus::out_of_cycles) return give_up(unmet_criterion());
        if (status == StageStatus::done) {
          if (!end_stage()) return interrupt();
          continue;
        }
        if (caught_signal != 0) return interrupt();
        if (cost_.cycles == 0 || simulation_.state().stage_cycle == 0) warn_of_too_many_cycles();
        cycle();
      }
    } catch (const CellTooThin& error) {
      return give_up(thin_cell(error.place));
    } catch (const Diverged& error) {
      warn(error.what());
      results_.finish_without_state();
      print_costs();
      return not_reached;
    } catch (const VerificationFault& fault) {
      return stop_at(fault);
    } catch (const WriteError&) {
      save_what_can_be();
      throw;
    }
    progress_.show(1.0, where());
    progress_.finish();
    cost_.wall_seconds = seconds_since(start_);
    if (verification_ != nullptr) cost_.verified = verification_->verified();
    results_.finish(simulation_, cost_);
    print_costs();
    return success;
  }

 private:
  void cycle() {
    {
      const AddedSeconds timer(cost_.cycle_seconds);
      simulation_.step();
    }
    ++cost_.cycles;
    work_.note(simulation_.state().energy);
    if (verification_ != nullptr) verification_->check(simulation_);
    cost_.listed_pair_cycles += static_cast<double>(simulation_.state().list.pairs().size());

    const OutputIntervals& every = simulation_.scene().output;
    const std::int64_t now = simulation_.state().cycle;
    if (is_due(simulation_, every.history, every.history_strain)) add_row();
    if (is_due(simulation_, every.micro)) results_.add_micro(simulation_);
    if (is_due(simulation_, every.frame, every.frame_strain)) results_.add_frame(simulation_);
    if (is_due(simulation_, every.contacts)) results_.add_contacts(simulation_);
    results_.kept().after_cycle(simulation_);
    const bool by_cycles = every.checkpoint > 0 && now % every.checkpoint == 0;
    const bool by_time = every.checkpoint_seconds > 0.0 &&
                         seconds_since(last_checkpoint_) >= every.checkpoint_seconds;
    if (by_cycles || by_time) {
      results_.checkpoint(simulation_);
      last_checkpoint_ = Clock::now();
    }
    if (progress_.is_due()) show_progress();
  }

  /// A row of the history, of a cycle.
  void add_row() {
    if (verification_ != nullptr) verification_->recount(simulation_, true);
    results_.add_row(simulation_);
  }

  void show_progress() {
    const double stages = static_cast<double>(simulation_.scene().stages.size());
    const double done = static_cast<double>(simulation_.state().stage);
    progress_.show((done - 1.0 + simulation_.stage_fraction()) / (stages - 1.0), where(),
                   most_cycles_left() * seconds_since(start_) / static_cast<double>(cost_.cycles));
  }

  /// The cycles that the run has at most: those that its stages' max_cycles leave. It ends with a
  /// stage that needs more.
  double most_cycles_left() const {
    const auto& stages = simulation_.scene().stages;
    double left = cycles_allowed();
    if (simulation_.cycles_needed().cycles > left) return left;
    for (std::size_t k = simulation_.state().stage + 1; k < stages.size(); ++k)
      left += static_cast<double>(stages[k].drive->max_cycles);
    return left;
  }

  /// Of the current stage.
  double cycles_allowed() const {
    return static_cast<double>(simulation_.stage().drive->max_cycles -
                               simulation_.state().stage_cycle);
  }

  /// What `tangency-dem check` advises. Of cycles the current stage says it itself, and the others
  /// do not say it again.
  void warn_by_check() {
    for (const Advice& one : check_of(simulation_).advice) {
      const bool is_of_cycles = one.about == "cycles";
      if (is_of_cycles && one.stage == simulation_.stage().name) continue;
      if (is_of_cycles) told_of_cycles_.push_back(one.stage);
      warn("check: " + one.text());
    }
  }

  void warn_of_too_many_cycles() {
    const auto [cycles, key] = simulation_.cycles_needed();
    const auto& told = told_of_cycles_;
    if (!(cycles > cycles_allowed()) ||
        std::find(told.begin(), told.end(), simulation_.stage().name) != told.end())
      return;
    const Stage& stage = simulation_.stage();
    warn("stage " + stage.name + " cannot end within max_cycles = " +
         std::to_string(stage.drive->max_cycles) + ": it needs " +
         tables::formatted("%.0f", cycles) + (simulation_.state().stage_cycle > 0 ? " more" : "") +
         " cycles for its " + key + "; " + advice_on_cycles(simulation_, cycles));
  }

  std::string where() const {
    const Observation seen = simulation_.observe();
    return simulation_.stage().name + ", cycle " + std::to_string(simulation_.state().cycle) +
           ", mean stress " + short_text(seen.stress.mean());
  }

  /// False where a signal came while the stage's points were kept: the stage is at its end still.
  bool end_stage() {
    // Without a cycle of this process in it the laws may be others than those of its contacts.
    if (verification_ != nullptr)
      verification_->recount(simulation_, cost_.cycles > 0 && simulation_.state().stage_cycle > 0);
    results_.add_last_row_of_stage(simulation_);
    results_.add_frame(simulation_);
    results_.add_contacts(simulation_);
    if (!keep_points()) return false;
    warn_of_unsound_stage();
    warn_of_missed_targets();
    simulation_.next_stage();
    results_.kept().after_stage(simulation_);
    return true;
  }

  bool keep_points() {
    const std::string& stage = simulation_.stage().name;
    const auto goes_on = [&](double share) {
      if (progress_.is_due()) progress_.show(share, stage + ", once more for its points");
      return caught_signal == 0;
    };
    const auto [was_stopped, problem] = results_.keep_points(simulation_, goes_on);
    if (!problem.empty()) warn("states B, C and D of stage " + stage + " are not kept: " + problem);
    return !was_stopped;
  }

  void warn_of_unsound_stage() {
    const Observation seen = simulation_.observe();
    const std::string ended = "stage " + simulation_.stage().name + " ended with ";
    const double fraction = seen.balance.inertial_fraction;
    const auto is_meant = [&](const char* about) {
      return simulation_.scene().intends(simulation_.stage(), about);
    };
    if (fraction > kSoundInertialFraction && !is_meant("inertial_number")) {
      const std::string advice = advice_on_motion(simulation_, seen, kSoundInertialFraction);
      if (!advice.empty())
        warn(ended + "inertial fraction " + short_text(fraction) + ", above " +
             short_text(kSoundInertialFraction) + ": " + advice);
    }
    const double step = simulation_.time_step_ratio();
    if (step > kSoundTimeStepRatio)
      warn(ended + "time step " + short_text(step) + " of the critical one, above " +
           short_text(kSoundTimeStepRatio) +
           ": what it computed may be wrong without looking it; " +
           advice_on_step(simulation_, 1.0 / step));
    const double through = work_.sum();
    // An error of second order in the step; halved at least, since what is large may not be so yet.
    const double error = std::abs(seen.energy_error) / through;
    if (std::abs(seen.energy_error) > kSoundEnergyError * through)
      warn(ended + "an energy error of " + short_text(seen.energy_error / through) +
           " of the work done, beyond " + short_text(kSoundEnergyError) +
           ": the step makes or loses energy; " +
           advice_on_step(simulation_, std::min(0.5, std::sqrt(kSoundEnergyError / error))));
    const double overlap = seen.mean_overlap / mean_radius(simulation_.scene());
    if ((overlap > kSoundOverlap && !is_meant("overlap")) || seen.porosity < 0.0)
      warn(ended + "mean overlap " + short_text(overlap) + " of the mean radius and porosity " +
           short_text(seen.porosity) + "; sound are at most " + short_text(kSoundOverlap) +
           " and at least 0: the particles are too soft for what they bear; " +
           advice_on_stiffness(simulation_, std::max(2.0, overlap / kSoundOverlap)));
  }

  /// Why the run ends, and where.
  std::string thin_cell(const ThinPlace& place) const {
    const Observation seen = simulation_.observe();
    return "stage " + simulation_.stage().name + " stopped in cycle " +
           std::to_string(simulation_.state().cycle) + " at axial strain " +
           short_text(seen.axial_strain) + " and volumetric strain " +
           short_text(seen.volumetric_strain) + ": " + place.what + "; " +
           advice_on_thickness(simulation_, place);
  }

  /// Of the servos whose stage ends whether or not they hold.
  void warn_of_missed_targets() {
    const Drive& stage = *simulation_.stage().drive;
    if (stage.stress_tolerance) return;
    const Stress stress = simulation_.observe().stress;
    for (std::size_t k = 0; k < stage.loading.targets.size(); ++k) {
      const Target& target = stage.loading.targets[k];
      const ServoMemory& seen = simulation_.state().servos[k];
      const double share = static_cast<double>(seen.missed) / static_cast<double>(seen.watched);
      const std::string held = "stage " + simulation_.stage().name + " did not hold " +
                               target.name + " at " + short_text(target.wanted) + ": ";
      if (seen.watched == 0 && stage.duration)
        warn(held + "it never came there and ended at " + short_text(target.measured(stress)) +
             "; " + advice_on_servo(simulation_));
      else if (share > kSoundMissedShare || std::abs(seen.worst) > kSoundMiss)
        warn(held + "it was off by more than " + short_text(100.0 * kHeldWithin) + " % in " +
             short_text(100.0 * share) + " % of the cycles, by " + short_text(100.0 * seen.worst) +
             " % at worst; " + advice_on_servo(simulation_));
    }
  }

  std::string unmet_criterion() const {
    const Drive& stage = *simulation_.stage().drive;
    const Observation seen = simulation_.observe();
    std::vector<std::string> unmet;
    const auto compare = [&](const std::string& what, double is, double wanted) {
      unmet.push_back(what + " " + short_text(is) + " of " + short_text(wanted));
    };
    for (const Target& target : simulation_.loading().targets)
      compare(target.name, target.measured(seen.stress), target.wanted);
    if (stage.axial_strain) compare("axial strain", seen.axial_strain, *stage.axial_strain);
    if (stage.duration)
      compare("duration", static_cast<double>(simulation_.state().stage_cycle),
              static_cast<double>(*stage.duration));
    if (stage.max_unbalanced_ratio) {
      compare("largest unbalanced force", seen.balance.largest_unbalanced_ratio,
              *stage.max_unbalanced_ratio);
      compare("moment", seen.balance.largest_unbalanced_moment_ratio, *stage.max_unbalanced_ratio);
    }
    std::string text = "stage " + simulation_.stage().name +
                       " did not end within max_cycles = " + std::to_string(stage.max_cycles);
    for (const std::string& one : unmet) text += (&one == &unmet.front() ? ": " : ", ") + one;
    std::string gravity;  // that keeps it out of balance
    if (stage.max_unbalanced_ratio)
      gravity = advice_on_gravity(simulation_, seen, *stage.max_unbalanced_ratio);
    return text + "; " + (gravity.empty() ? advice_on_cycles(simulation_, more_cycles()) : gravity);
  }

  /// What the stage still needs: by its rates, or where it waits for a stress by the share of it
  /// that is done. Of balance that share is a guess, and so is at most ten times what it had.
  double more_cycles() const {
    const double known = simulation_.cycles_needed().cycles;
    const Drive& stage = *simulation_.stage().drive;
    if (!stage.stress_tolerance && !stage.max_unbalanced_ratio) return known;
    const double least = stage.max_unbalanced_ratio ? 0.1 : 0.001;
    const double done = std::clamp(simulation_.stage_fraction(), least, 0.9);
    return std::max(known,
                    static_cast<double>(simulation_.state().stage_cycle) * (1.0 - done) / done);
  }

  int give_up(const std::string& why) {
    warn(why);
    results_.add_row(simulation_);
    if (simulation_.scene().output.micro > 0) results_.add_micro(simulation_);
    results_.add_contacts(simulation_);
    results_.finish_incomplete(simulation_);
    print_costs();
    return not_reached;
  }

  /// What was written before stays: a checkpoint of a state that was found wrong would take the
  /// place of a good one.
  int stop_at(const VerificationFault& fault) {
    const std::filesystem::path state = out_ / "fault.state";
    warn(std::string("fault: ") + fault.what() + "; the state is in " + state.string() +
         ", checkpoint.state stays as it was");
    save_state(simulation_.state(), state);
    results_.finish_without_state();
    print_costs();
    return fault_found;
  }

  /// A frame may have found the disk full, and a state still have room.
  void save_what_can_be() {
    try {
      results_.checkpoint(simulation_);
    } catch (const WriteError&) {  // the first failure is the one to tell of
    }
  }

  int interrupt() {
    results_.finish_incomplete(simulation_);
    warn("interrupted in cycle " + std::to_string(simulation_.state().cycle) +
         "; continue with --resume " + (out_ / "checkpoint.state").string());
    print_costs();
    return 128 + caught_signal;
  }

  void print_costs() {
    if (verification_ != nullptr) warn(text_of(verification_->verified()));
    if (!cost_.profile) return;
    tables::OutputFile("-").write(table_of(*cost_.profile, cost_.cycle_seconds));
  }

  void warn(const std::string& message) {
    progress_.finish();
    std::cerr << "tangency-dem: " << message << std::endl;
  }

  Clock::time_point start_ = Clock::now();
  Clock::time_point last_checkpoint_ = start_;
  Simulation simulation_;
  Verification* verification_;
  std::filesystem::path out_;
  bool quiet_;
  Results results_;
  tables::Progress progress_;
  std::vector<std::string> told_of_cycles_;  ///< stages
  RunCost cost_;
  WorkDone work_;  ///< from where the run goes on
};

/// Placing many particles takes a while, too.
Simulation placed(const Scene& scene, bool quiet) {
  tables::Progress progress(
      quiet ? tables::Progress::Shown::nothing : tables::Progress::Shown::everywhere, 0.0);
  return Simulation(scene, [&](double share) {
    if (share > 0.0 && progress.is_due()) progress.show(share, "particles that have their place");
  });
}

}  // namespace

void catch_interrupts() {
  for (const int number : {SIGPIPE, SIGXFSZ}) std::signal(number, SIG_IGN);
  for (const int number : {SIGHUP, SIGINT, SIGTERM}) {
    struct sigaction action {};
    sigaction(number, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = catch_signal;
    action.sa_flags = SA_RESTART;
    sigaction(number, &action, nullptr);
  }
}

SceneFile scene_file_of(const RunOptions& options) {
  SceneFile file(options.scene);
  for (const std::string& assignment : options.settings) file.set(assignment);
  return file;
}

Simulation simulation_of(const RunOptions& options, const SceneFile& file) {
  if (options.resume) return simulation_of(options, file, load_state(*options.resume));
  Scene scene = file.scene();
  read_bodies(scene, file, options.scene);
  try {
    return placed(scene, options.quiet);
  } catch (const CellTooThin& error) {
    throw SceneError(options.scene.string() + ": " + error.what());
  } catch (const DoesNotFit& error) {
    throw SceneError(options.scene.string() + ": " + error.what());
  }
}

Simulation simulation_of(const RunOptions& options, const SceneFile& file, State state) {
  Scene scene = file.scene();
  read_bodies(scene, file, options.scene);
  try {
    return Simulation(scene, std::move(state));
  } catch (const std::invalid_argument& error) {
    throw StateError(options.resume->string() + ": " + error.what());
  }
}

int run(const RunOptions& options, const SceneFile& file) {
  if (options.reproducible) use_reproducible_arithmetic();
  if (options.threads > 0) set_threads(options.threads);
  Simulation simulation = simulation_of(options, file);
  if (caught_signal != 0) {
    std::cerr << "tangency-dem: interrupted before the first cycle; nothing was written"
              << std::endl;
    return 128 + caught_signal;
  }
  std::optional<Verification> verification;
  if (options.verify) {
    try {
      verification.emplace().check(simulation);
      verification->recount(simulation, false);
    } catch (const VerificationFault& fault) {
      std::cerr << "tangency-dem: fault before the first cycle: " << fault.what()
                << "; nothing was written" << std::endl;
      return fault_found;
    }
  }
  return Run(std::move(simulation), options, verification ? &*verification : nullptr).execute();
}

}  // namespace tangency::inline v0::dem
