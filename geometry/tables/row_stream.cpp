// SPDX-License-Identifier: MIT
#include <tangency/geometry/tables/row_stream.hpp>

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/geometry/tables/progress.hpp>

namespace tangency::inline v0::tables {
namespace {

// Chosen: enough to see what is wrong with a file, and not a second file.
constexpr std::size_t kMostComplaints = 10;

// Chosen: smaller files are done before anyone has read the line.
constexpr std::uint64_t kSmallestFileWithProgress = 4'000'000;

// Of the input, below which another thread is not worth starting; chosen: about 100 us of work.
constexpr std::uint64_t kBytesPerThread = 1 << 16;

// Chosen: enough for every vector register, few enough to stay in cache.
constexpr std::size_t kRowsAtOnce = 256;

/// The answers of a RowFunction, as they were written, a line each.
class RowByRow : public Rows {
 public:
  explicit RowByRow(RowFunction function) : function_(std::move(function)) {}
  void read(const RowCursor& row) override {
    const std::size_t begin = text_.size();
    try {
      const RowOutcome outcome = function_(row, text_);
      answers_.push_back({begin, text_.size(), outcome});
      text_.end_row();
    } catch (...) {
      text_.truncate(begin);
      throw;
    }
  }
  void answer() override {}
  RowOutcome write(std::size_t i, RowText& out) const override {
    const Answer& answer = answers_[i];
    out.cells(text_.view().substr(answer.begin, answer.end - answer.begin));
    return answer.outcome;
  }
  void clear() override {
    answers_.clear();
    text_.clear();
  }

 private:
  struct Answer {
    std::size_t begin, end;  ///< of its cells in the text
    RowOutcome outcome;
  };

  RowFunction function_;
  RowText text_;
  std::vector<Answer> answers_;
};

/// One block of rows on its way through a thread.
struct Job {
  std::unique_ptr<Rows> rows;
  std::vector<std::pair<std::uint64_t, bool>> taken;  ///< number of a row, and is it valid?
  std::uint64_t turn = 0;
  Block block;
  RowText text;
  bool all_answered = true;
  std::size_t invalid_rows = 0;
  std::vector<std::string> complaints;
  std::exception_ptr refusal;
};

/// Every thread takes a block, answers its rows, waits for its turn and writes them: no queue, and
/// as many blocks in memory as threads.
class RowStream {
 public:
  RowStream(const RowTask& task, const RowStreamOptions& options);
  ExitStatus run();

 private:
  Progress::Shown shown_progress() const;
  void show_progress(std::uint64_t bytes);
  unsigned useful_threads() const;
  void work();
  bool take(Job& job);
  void answer(Job& job) const;
  void complain(const Error& error, std::uint64_t row, Job& job) const;
  void write_taken(Job& job) const;
  void write_invalid(RowText& text) const;
  void deliver(Job& job);
  void tally(const Job& job);

  const RowTask& task_;
  const RowStreamOptions& options_;
  Reader reader_;
  MakeRows make_rows_;
  OutputFile output_;
  Progress progress_;

  std::mutex input_mutex_;
  std::uint64_t turns_taken_ = 0;
  bool input_ended_ = false;

  std::mutex output_mutex_;
  std::condition_variable turn_delivered_;
  std::uint64_t turns_delivered_ = 0;
  bool all_answered_ = true;
  std::size_t invalid_rows_ = 0;
  std::size_t complaints_shown_ = 0;
  std::exception_ptr refusal_;
};

RowStream::RowStream(const RowTask& task, const RowStreamOptions& options)
    : task_(task),
      options_(options),
      reader_(options.input),
      make_rows_(task.bind(reader_.header())),
      output_(options.output),
      progress_(shown_progress(), 0.0) {}

Progress::Shown RowStream::shown_progress() const {
  const bool long_enough = reader_.total_bytes().value_or(0) > kSmallestFileWithProgress;
  return long_enough && !output_.is_terminal() ? Progress::Shown::on_terminal
                                               : Progress::Shown::nothing;
}

void RowStream::show_progress(std::uint64_t bytes) {
  if (bytes == 0 || !progress_.is_due()) return;
  const double done =
      static_cast<double>(bytes) / static_cast<double>(reader_.total_bytes().value_or(bytes));
  progress_.show(done, formatted("%s: %.0f %%", reader_.header().file().c_str(), 100 * done));
}

unsigned RowStream::useful_threads() const {
  const std::uint64_t wanted = reader_.total_bytes().value_or(UINT64_MAX) / kBytesPerThread + 1;
  return static_cast<unsigned>(std::min<std::uint64_t>(options_.threads, wanted));
}

ExitStatus RowStream::run() {
  RowText header;
  header.header(task_.output_columns);
  output_.write(header.view());
  {
    std::vector<std::jthread> helpers;
    try {
      for (unsigned i = 1; i < useful_threads(); ++i) helpers.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
      // The system grants no more threads; those that run do all of the work.
    }
    work();
  }
  progress_.clear();
  if (refusal_) std::rethrow_exception(refusal_);
  output_.commit();
  if (invalid_rows_ > complaints_shown_) {
    std::fprintf(stderr, "%s: %zu invalid rows, of which the first %zu are named above\n",
                 reader_.header().file().c_str(), invalid_rows_, complaints_shown_);
  }
  return all_answered_ ? every_row_answered : some_row_unanswered;
}

void RowStream::work() {
  Job job;
  job.rows = make_rows_();
  while (take(job)) {
    if (!job.refusal) answer(job);
    deliver(job);
  }
}

bool RowStream::take(Job& job) {
  const std::lock_guard lock(input_mutex_);
  if (input_ended_) return false;
  job.text.clear();
  job.all_answered = true;
  job.invalid_rows = 0;
  job.complaints.clear();
  job.refusal = nullptr;
  try {
    input_ended_ = !reader_.read(job.block);
    if (input_ended_) return false;
  } catch (...) {
    input_ended_ = true;
    job.refusal = std::current_exception();  // once the blocks before it have been written
  }
  job.turn = turns_taken_++;
  return true;
}

void RowStream::answer(Job& job) const {
  RowCursor row(reader_.header());
  row.enter(job.block);
  std::exception_ptr refusal;
  for (bool more = true; more && !refusal;) {
    try {
      more = row.next();
      if (more) job.rows->read(row), job.taken.emplace_back(row.index(), true);
    } catch (const Error& error) {
      if (!options_.keep_going) refusal = std::current_exception();
      if (options_.keep_going) complain(error, row.index(), job);
    } catch (...) {
      refusal = std::current_exception();
    }
    // Those before a refused row are answered too.
    if (!more || refusal || job.taken.size() == kRowsAtOnce) write_taken(job);
    if (job.refusal) return;
  }
  job.refusal = refusal;
}

void RowStream::complain(const Error& error, std::uint64_t row, Job& job) const {
  job.taken.emplace_back(row, false);
  ++job.invalid_rows;
  if (job.complaints.size() < kMostComplaints) job.complaints.emplace_back(error.what());
}

void RowStream::write_taken(Job& job) const {
  std::size_t whole_rows = job.text.size();
  try {
    job.rows->answer();
    std::size_t answered = 0;
    for (const auto& [row, valid] : job.taken) {
      const bool is_line = valid && task_.writes_lines;
      if (!is_line) job.text.integer(row);
      if (!valid) {
        write_invalid(job.text);
      } else if (job.rows->write(answered++, job.text) == RowOutcome::unanswered) {
        job.all_answered = false;
      }
      if (!is_line) job.text.end_row();
      whole_rows = job.text.size();
    }
  } catch (...) {
    job.text.truncate(whole_rows);
    job.refusal = std::current_exception();
  }
  job.taken.clear();
  job.rows->clear();
}

void RowStream::write_invalid(RowText& text) const {
  for (std::size_t i = 1; i < task_.output_columns.size(); ++i) {
    text.text(task_.output_columns[i] == task_.verdict_column ? "invalid" : "");
  }
}

void RowStream::deliver(Job& job) {
  std::unique_lock lock(output_mutex_);
  turn_delivered_.wait(lock, [&] { return turns_delivered_ == job.turn; });
  if (!refusal_) {
    refusal_ = job.refusal;
    try {
      output_.write(job.text.view());
      tally(job);
    } catch (...) {
      refusal_ = std::current_exception();
    }
    if (refusal_) reader_.cancel();
  }
  ++turns_delivered_;
  turn_delivered_.notify_all();
}

void RowStream::tally(const Job& job) {
  if (!job.all_answered || job.invalid_rows > 0) all_answered_ = false;
  for (const std::string& complaint : job.complaints) {
    if (complaints_shown_ == kMostComplaints) break;
    progress_.clear();
    std::fprintf(stderr, "%s\n", complaint.c_str());
    ++complaints_shown_;
  }
  invalid_rows_ += job.invalid_rows;
  show_progress(job.block.end_offset);
}

}  // namespace

BindRows row_by_row(std::function<RowFunction(const Header&)> bind) {
  return [bind = std::move(bind)](const Header& header) -> MakeRows {
    return [function = bind(header)] { return std::make_unique<RowByRow>(function); };
  };
}

ExitStatus run_row_stream(const RowTask& task, const RowStreamOptions& options) {
  return RowStream(task, options).run();
}

}  // namespace tangency::inline v0::tables
