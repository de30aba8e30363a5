// The report as Markdown tables: medians, for people.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/measure/bench/report.h"
#include "tests/measure/bench/summary.h"
#include "tests/measure/report/markdown_table.h"

namespace raytracer::bench {
namespace {

using measure::digits;
using measure::percent;
using measure::row;

constexpr const char* heading =
    "Times are milliseconds, medians over rounds in which the project and one peer ran once; "
    "ratios are medians of the rounds' ratios, above 1 where the project is faster. A scene has "
    "the size and the samples of its document where nothing else is said.\n";

/// The figures of `name` for a case; every case has those of every peer.
const PeerFigures& of_peer(const CaseFigures& figures, const std::string& name) {
  return *std::find_if(figures.peers.begin(), figures.peers.end(),
                       [&](const PeerFigures& peer) { return peer.name == name; });
}

/// The worst first: there is where users lose most.
std::vector<const CaseFigures*> by_worst_ratio(const Report& report) {
  std::vector<std::pair<double, const CaseFigures*>> ratios;
  for (const CaseFigures& figures : report.cases)
    ratios.emplace_back(worst_ratio(figures), &figures);
  std::stable_sort(ratios.begin(), ratios.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const CaseFigures*> cases;
  for (const auto& [ratio, figures] : ratios) cases.push_back(figures);
  return cases;
}

std::string overview_table(const Report& report) {
  std::string head = "| scene | worst | build, ms | trace, ms |";
  std::string rule = "|:--|--:|--:|--:|";
  for (const auto& [name, version] : report.head.peers) {
    head += fmt::format(" {}: trace | with build |", name);
    rule += "--:|--:|";
  }
  std::string text =
      "\n## How many times as long others take\n\nThe worst first.\n\n" + head + '\n' + rule + '\n';
  for (const CaseFigures* const each : by_worst_ratio(report)) {
    const CaseFigures& figures = *each;
    const ProjectTimes times = summarize(figures).project;
    const double worst = worst_ratio(figures);
    text += fmt::format("| {} | {} | {} | {} |", figures.measured.name(),
                        std::isfinite(worst) ? digits(worst) + 'x' : "-", digits(times.build_ms),
                        digits(times.trace_ms));
    for (const auto& [name, version] : report.head.peers) {
      const PeerFigures& peer = of_peer(figures, name);
      const PeerSummary summary = peer.refusal ? PeerSummary{} : summarize(peer);
      text += peer.refusal ? " - | - |"
                           : fmt::format(" {}x | {}x |", digits(summary.trace_ratio),
                                         digits(summary.build_and_trace_ratio));
    }
    text += '\n';
  }
  for (const CaseFigures& figures : report.cases)
    for (const PeerFigures& peer : figures.peers)
      if (peer.refusal)
        text += fmt::format("\n{} cannot draw {}: {}\n", peer.name, figures.measured.name(),
                            *peer.refusal);
  return text;
}

std::string project_table(const Report& report) {
  std::string text = "\n## The project\n\n";
  text += row("scene", "size", "samples", "rounds", "document, MB", "covered", "read", "plan",
              "build", "trace", "encode", "in all");
  text += "|:--|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const CaseFigures& figures : report.cases) {
    const ProjectTimes times = summarize(figures).project;
    text += row(figures.measured.name(),
                fmt::format("{} x {}", figures.width_px, figures.height_px), figures.samples,
                figures.rounds.size(), digits(static_cast<double>(figures.document_bytes) / 1e6),
                fmt::format("{:.0f} %", 100 * figures.covered), digits(times.read_ms),
                digits(times.plan_ms), digits(times.build_ms), digits(times.trace_ms),
                digits(times.encode_ms), digits(whole_ms(times)));
  }
  return text;
}

std::string forecast_table(const Report& report) {
  std::string text =
      "\n## Predicted and measured\n\n"
      "What a plan predicts before each render, over what that render then took; and how long the "
      "prediction takes, building the structures included.\n\n";
  text += row("scene", "build predicted", "measured", "**ratio**", "trace predicted", "measured",
              "**ratio**", "taken");
  text += "|:--|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const CaseFigures& figures : report.cases) {
    const auto [project, forecast] = summarize(figures);
    text +=
        row(figures.measured.name(), digits(forecast.times.build_ms), digits(project.build_ms),
            digits(forecast.build_ratio), digits(forecast.times.trace_ms), digits(project.trace_ms),
            digits(forecast.trace_ratio), digits(forecast.times.taken_ms));
  }
  return text;
}

std::string peer_table(const Report& report, const std::string& name) {
  std::string text = fmt::format(
      "\n## Beside {}\n\n"
      "Its own account of its stages; \"whole\": a program from its start to its end, over the "
      "project from text to PNG. The pictures: root mean square of their difference, with "
      "channels from 0 to 1, and the pixels with a channel off by more than two levels of 255.\n\n",
      name);
  text += row("scene", "rounds", "read", "build", "trace", "by", "whole", "our trace",
              "**trace ratio**", "**with build**", "**whole**", "rmse", "pixels off",
              "known differences");
  text += "|:--|--:|--:|--:|--:|:--|--:|--:|--:|--:|--:|--:|--:|:--|\n";
  for (const CaseFigures& figures : report.cases) {
    const PeerFigures& peer = of_peer(figures, name);
    if (peer.refusal) continue;
    const PeerSummary summary = summarize(peer);
    const bool is_program = summary.times.whole_ms > 0;
    text += row(figures.measured.name(), peer.rounds.size(), digits(summary.times.read_ms),
                digits(summary.times.build_ms), digits(summary.times.trace_ms), summary.way,
                is_program ? digits(summary.times.whole_ms) : "-", digits(summary.project_trace_ms),
                digits(summary.trace_ratio), digits(summary.build_and_trace_ratio),
                is_program ? digits(summary.whole_ratio) : "-",
                fmt::format("{:.2g}", peer.difference.rmse), percent(peer.difference.share_off),
                fmt::format("{}", fmt::join(peer.differences, "; ")));
  }
  return text;
}

}  // namespace

std::string to_markdown(const Report& report) {
  std::string text = to_markdown(report.head, "Bench") + heading + overview_table(report) +
                     project_table(report) + forecast_table(report);
  for (const auto& version : report.head.peers)
    if (std::any_of(report.cases.begin(), report.cases.end(),
                    [&](const CaseFigures& each) { return !of_peer(each, version.first).refusal; }))
      text += peer_table(report, version.first);
  return text;
}

}  // namespace raytracer::bench
