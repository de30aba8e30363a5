// The report as a Markdown table: medians, for people.

#include <fmt/format.h>

#include "tests/measure/bench/report.h"
#include "tests/measure/bench/summary.h"
#include "tests/measure/report/markdown_table.h"

namespace raytracer::bench {
namespace {

std::string heading(const Report& report) {
  std::string text = fmt::format(
      "# Bench, {}, commit {}\n\n"
      "- processor: {}, {} cores, {}; {} threads for every peer\n"
      "- system: {}; compiler: {}\n",
      report.date, report.commit, report.machine.processor, report.machine.cores,
      report.machine.vectors, report.thread_count, report.machine.system, report.machine.compiler);
  if (report.embree) text += fmt::format("- Embree {}\n", *report.embree);
  if (report.povray) text += fmt::format("- POV-Ray {}\n", *report.povray);
  text += fmt::format("- command: `{}`\n\n", report.command);
  return text +
         "Times are milliseconds, medians over rounds in which the project and one peer ran once, "
         "first those with Embree; ratios are medians of the rounds' ratios, above 1 where the "
         "project is faster. 700 x 500 pixels and one sample where nothing else is said. \"Pixels "
         "off\": those with a channel more than two of 255 levels from the project's, and the mean "
         "difference in levels.\n";
}

std::string project_table(const Report& report, const std::vector<Summary>& summaries) {
  std::string text = "\n## The project\n\n";
  text += row("case", "rounds", "document, MB", "covered", "read", "plan", "build", "trace",
              "encode", "in all");
  text += "|:--|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const CaseFigures& figures = report.cases[i];
    const ProjectTimes& times = summaries[i].project;
    text += row(
        figures.measured.name(), figures.rounds.size(),
        digits(static_cast<double>(figures.document_bytes) / 1e6),
        fmt::format("{:.0f} %", 100 * figures.covered), digits(times.read_ms),
        digits(times.plan_ms), digits(times.build_ms), digits(times.trace_ms),
        digits(times.encode_ms),
        digits(times.read_ms + times.plan_ms + times.build_ms + times.trace_ms + times.encode_ms));
  }
  return text;
}

std::string forecast_table(const Report& report, const std::vector<Summary>& summaries) {
  std::string text =
      "\n## Foreseen and measured\n\n"
      "What a plan predicts before each render, over what that render then took; and how long the "
      "prediction takes, building the structures included.\n\n";
  text += row("case", "build foreseen", "measured", "**ratio**", "trace foreseen", "measured",
              "**ratio**", "taken");
  text += "|:--|--:|--:|--:|--:|--:|--:|--:|\n";
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const ForecastSummary& forecast = summaries[i].forecast;
    text += row(report.cases[i].measured.name(), digits(forecast.times.build_ms),
                digits(summaries[i].project.build_ms), digits(forecast.build_ratio),
                digits(forecast.times.trace_ms), digits(summaries[i].project.trace_ms),
                digits(forecast.trace_ratio), digits(forecast.times.taken_ms));
  }
  return text;
}

std::string embree_table(const Report& report, const std::vector<Summary>& summaries) {
  std::string text =
      "\n## Against Embree\n\n"
      "Its trace time is that of its best way; its build is the commit without filling its "
      "arrays.\n\n";
  text += row("case", "its build", "its trace", "by", "our trace", "**trace ratio**",
              "**with build**", "pixels off", "mean");
  text += "|:--|--:|--:|:--|--:|--:|--:|--:|--:|\n";
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const std::optional<EmbreeSummary>& embree = summaries[i].embree;
    if (!embree) continue;
    const ImageDifference& off = *report.cases[i].embree_off;
    text +=
        row(report.cases[i].measured.name(), digits(embree->times.build_ms),
            digits(embree->trace_ms), name_of(embree->mode), digits(summaries[i].project.trace_ms),
            digits(embree->trace_ratio), digits(embree->build_and_trace_ratio),
            percent(off.share_off), fmt::format("{:.3f}", off.mean_levels));
  }
  return text;
}

std::string povray_table(const Report& report, const std::vector<Summary>& summaries) {
  std::string text =
      "\n## Against POV-Ray\n\n"
      "Its own account of parsing, bounding and tracing, and the whole process against the "
      "project from text to PNG. Its pictures are compared with the project's without ambient "
      "light, which POV-Ray counts differently; its pattern of 16 samples is another. After a "
      "process of seconds the project finds a processor that has slept and memory given back: its "
      "times are longer here.\n\n";
  text += row("case", "rounds", "its parse", "its bounding", "its trace", "its process",
              "our trace", "**trace ratio**", "**process ratio**", "pixels off", "mean");
  text += "|:--|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const std::optional<PovraySummary>& povray = summaries[i].povray;
    if (!povray) continue;
    const ImageDifference& off = *report.cases[i].povray_off;
    text +=
        row(report.cases[i].measured.name(), povray->round_count, digits(povray->times.parse_ms),
            digits(povray->times.bounding_ms), digits(povray->times.trace_ms),
            digits(povray->times.process_ms), digits(povray->project_trace_ms),
            digits(povray->trace_ratio), digits(povray->process_ratio), percent(off.share_off),
            fmt::format("{:.3f}", off.mean_levels));
  }
  return text;
}

}  // namespace

std::string to_markdown(const Report& report) {
  std::vector<Summary> summaries;
  for (const CaseFigures& figures : report.cases) summaries.push_back(summarize(figures));
  std::string text =
      heading(report) + project_table(report, summaries) + forecast_table(report, summaries);
  if (report.embree) text += embree_table(report, summaries);
  if (report.povray) text += povray_table(report, summaries);
  return text;
}

}  // namespace raytracer::bench
