#include "host/tools/paper/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/base/parallel.h"
#include "host/base/version.h"
#include "host/cli/json.h"
#include "host/cli/processor.h"

namespace duolux {

namespace {

struct Table {
    std::string caption;
    std::vector<std::string> head;
    std::vector<std::vector<std::string>> rows;
};

std::string percent(double x) {
    return fmt::format("{:.3f}", 100.0 * x);
}

struct Metric {
    const char* name;
    double Comparison::*value;
};
constexpr std::array<Metric, 4> kMetrics{{{"mean eps", &Comparison::epsMean},
                                          {"largest eps", &Comparison::epsMax},
                                          {"difference of the average colours", &Comparison::averageColour},
                                          {"pixels with eps > 1/255", &Comparison::epsAboveOneCode}}};

/// Rows: lights; columns: samples per pixel; one table for each metric, estimator and kind of OpenGL's
/// lighting.
std::vector<Table> errorTables(const ExperimentSetup& setup, const Experiment& experiment) {
    std::vector<Table> tables;
    for (const Metric& metric : kMetrics) {
        std::map<std::pair<std::string, std::string>, Table> byKind;
        for (const Cell& cell : experiment.cells) {
            Table& table = byKind[{cell.estimator, cell.lighting}];
            if (table.head.empty()) {
                table.caption = fmt::format(
                    "{} of `local`, {}, against OpenGL, {}, in %: **all pixels** (away from silhouettes / at "
                    "them)",
                    metric.name, cell.estimator, cell.lighting);
                table.head.emplace_back("lights");
                for (const std::uint32_t spp : setup.spp)
                    table.head.push_back(fmt::format("{} spp", spp));
            }
            auto row = std::ranges::find_if(table.rows, [&](const auto& r) { return r[0] == cell.lights; });
            if (row == table.rows.end()) row = table.rows.insert(row, {cell.lights});
            row->push_back(fmt::format("**{}** ({} / {})", percent(cell.all.*metric.value),
                                       percent(cell.smooth.*metric.value),
                                       percent(cell.silhouettes.*metric.value)));
        }
        for (const auto& [kind, table] : byKind)
            tables.push_back(table);
    }
    return tables;
}

Table residualTable(const Experiment& experiment) {
    Table table{
        "The residual with five lights, taken apart: mean eps in % (means of errors without sign: they do "
        "not add up)",
        {"between", "mean eps"},
        {}};
    for (const auto& [what, eps] : experiment.residual)
        table.rows.push_back({what, percent(eps)});
    return table;
}

Table speedTable(const Experiment& experiment) {
    Table table{
        "Seconds for 64 samples per pixel (`local`) and 64 passes with five lights (OpenGL, fixed function), "
        "of drawing alone; medians of runs in turns; in brackets the whole program, with loading, uploading "
        "and writing",
        {"triangles", "`local`, closed form", "`local`, sampled", "OpenGL", "OpenGL / closed form",
         "OpenGL / sampled"},
        {}};
    for (const Race& race : experiment.races) {
        const double transport = race.median(race.transport);
        const double sampled = race.median(race.sampled);
        const double gl = race.median(race.openGl);
        table.rows.push_back({fmt::format("{}", race.triangles),
                              fmt::format("{:.2f} ({:.2f})", transport, race.median(race.transportAll)),
                              fmt::format("{:.2f}", sampled),
                              fmt::format("{:.2f} ({:.2f})", gl, race.median(race.openGlAll)),
                              fmt::format("{:.2f}", gl / transport), fmt::format("{:.2f}", gl / sampled)});
    }
    return table;
}

/// The number of triangles for which both take equally long, interpolated logarithmically between two scenes.
std::optional<double> crossing(const Experiment& experiment) {
    for (std::size_t i = 1; i < experiment.races.size(); ++i) {
        const auto ratio = [](const Race& r) { return std::log(r.median(r.openGl) / r.median(r.transport)); };
        const Race& a = experiment.races[i - 1];
        const Race& b = experiment.races[i];
        if (ratio(a) >= 0.0 || ratio(b) < 0.0) continue;
        const double la = std::log(static_cast<double>(a.triangles));
        const double lb = std::log(static_cast<double>(b.triangles));
        return std::exp(la + (lb - la) * -ratio(a) / (ratio(b) - ratio(a)));
    }
    return std::nullopt;
}

std::vector<std::string> remarks(const ExperimentSetup& setup, const Experiment& experiment) {
    std::vector<std::string> lines;
    lines.push_back(fmt::format(
        "{} triangles, {} x {} pixels, OpenGL with {} passes. Transport on {}; OpenGL on {}; "
        "processor: {}. duolux {} ({}).",
        setup.triangles, setup.size, setup.size, setup.passes, experiment.device, experiment.openGl,
        fmt::format("{} ({} cores)", processorName(), workerCount()), versionString(), commitString()));
    lines.emplace_back(
        "32x32 lights are drawn per fragment alone: at vertices, eight at a time, they would take 128 "
        "drawings of the scene a pass.");
    lines.push_back(
        fmt::format("Silhouettes (where a pixel or one of its neighbours shows more than one object) are "
                    "{:.1f} % of the pixels.",
                    100.0 * experiment.silhouetteFraction));
    lines.emplace_back(
        "The paper reports a mean eps of 0.4 % and average colours that differ by less than 1/255 (0.392 "
        "%).");
    if (const auto triangles = crossing(experiment))
        lines.push_back(
            fmt::format("Both take as long at about {:.0e} triangles (flat normals, so that OpenGL can share "
                        "few vertices).",
                        *triangles));
    const auto toError = [&](const char* who, const TimeToError& t) {
        if (t.samples > 0) {
            lines.push_back(
                fmt::format("{} is within the paper's mean eps of 0.4 % with {} sample{} per pixel, after "
                            "{:.2f} s (eps {:.3f} %).",
                            who, t.samples, t.samples == 1 ? "" : "s", t.seconds, 100.0 * t.eps));
        }
    };
    toError("Transport, compared with OpenGL's 64 passes,", experiment.transportTo);
    toError("OpenGL, compared with transport's best picture,", experiment.openGlTo);
    return lines;
}

std::vector<Table> allTables(const ExperimentSetup& setup, const Experiment& experiment) {
    std::vector<Table> tables = errorTables(setup, experiment);
    tables.push_back(residualTable(experiment));
    if (!experiment.races.empty()) tables.push_back(speedTable(experiment));
    return tables;
}

std::string markdown(const Table& table) {
    const auto row = [](const std::vector<std::string>& cells) {
        std::string line = "|";
        for (const std::string& cell : cells)
            line += " " + cell + " |";
        return line + "\n";
    };
    return table.caption + ":\n\n" + row(table.head) +
           row(std::vector<std::string>(table.head.size(), "---")) +
           [&] {
               std::string lines;
               for (const auto& cells : table.rows)
                   lines += row(cells);
               return lines;
           }() +
           "\n";
}

/// Markdown's ** and ` as HTML.
std::string inlineHtml(const std::string& text) {
    std::string out;
    bool bold = false;
    bool code = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.compare(i, 2, "**") == 0) {
            out += bold ? "</b>" : "<b>";
            bold = !bold;
            ++i;
        } else if (text[i] == '`') {
            out += code ? "</code>" : "<code>";
            code = !code;
        } else if (text[i] == '<' || text[i] == '>') {
            out += text[i] == '<' ? "&lt;" : "&gt;";
        } else {
            out += text[i];
        }
    }
    return out;
}

std::string html(const Table& table) {
    std::string out = "<table><caption>" + inlineHtml(table.caption) + "</caption>\n<tr>";
    for (const std::string& cell : table.head)
        out += "<th>" + inlineHtml(cell) + "</th>";
    out += "</tr>\n";
    for (const auto& row : table.rows) {
        out += "<tr>";
        for (const std::string& cell : row)
            out += "<td>" + inlineHtml(cell) + "</td>";
        out += "</tr>\n";
    }
    return out + "</table>\n";
}

}  // namespace

std::string markdownTables(const ExperimentSetup& setup, const Experiment& experiment) {
    std::string out;
    for (const std::string& line : remarks(setup, experiment))
        out += line + "\n";
    out += "\n";
    for (const Table& table : allTables(setup, experiment))
        out += markdown(table);
    return out;
}

std::string htmlReport(const ExperimentSetup& setup, const Experiment& experiment) {
    std::string out = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Retro-rendering with vector-valued light: the evaluation repeated</title>
<style>
body { font: 15px/1.5 sans-serif; max-width: 1100px; margin: 2em auto; padding: 0 1em; }
img { max-width: 100%; }
table { border-collapse: collapse; margin: 1.5em 0; }
caption { text-align: left; padding: .3em 0; }
td, th { border: 1px solid #bbb; padding: .2em .6em; text-align: left; }
figcaption { color: #444; }
</style></head><body>
<h1>Local illumination from the transport equation, against OpenGL</h1>
<p>D. C. Banks and K. M. Beason, &ldquo;Retro-rendering with Vector-Valued Light&rdquo; (Proc. SPIE 6060, 2006), section 3, repeated.
eps of a pixel is the root mean square difference of its three channels, of displayed (sRGB) values from 0 to 1.</p>
)";
    for (const std::string& line : remarks(setup, experiment))
        out += "<p>" + inlineHtml(line) + "</p>\n";
    const auto figure = [&](const char* name, const char* caption) {
        out += fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n", name,
                           caption, caption);
    };
    out += "<h2>Figure 1</h2>\n";
    figure("figure1.png", "The four reflectances, luminaire visible (shadowless: four bounces)");
    out += "<h2>Figure 4</h2>\n";
    figure(
        "figure4-pictures.png",
        "Two spheres by OpenGL (fixed function, five lights) and by transport (sampled, the most samples)");
    figure("figure4-details.png",
           "Details of the left sphere: its mesh (a quarter of the other details' width); its edge, each "
           "pixel magnified eight times");
    out += "<h2>Where they differ</h2>\n";
    figure("heat-gl-5-fixed-function.png",
           "eps of that transport against OpenGL's fixed function with five lights; white is 2 %");
    figure("heat-gl-5-per-fragment.png",
           "The same against OpenGL per fragment: what lighting at vertices adds is gone");
    figure("mask.png", "White: away from silhouettes");
    out += "<h2>Tables</h2>\n";
    for (const Table& table : allTables(setup, experiment))
        out += html(table);
    return out + "</body></html>\n";
}

std::string jsonReport(const ExperimentSetup& setup, const Experiment& experiment) {
    nlohmann::ordered_json json;
    json["version"] = 1;
    json["setup"] = {{"triangles", setup.triangles}, {"size", setup.size},
                     {"passes", setup.passes},       {"device", experiment.device},
                     {"opengl", experiment.openGl},  {"commit", commitString()}};
    const auto metrics = [](const Comparison& c) {
        nlohmann::ordered_json out;
        for (const auto& [name, value] : c.metrics()) {
            if (std::isfinite(value)) out[std::string(name)] = value;
        }
        return out;
    };
    for (const Cell& c : experiment.cells) {
        json["cells"].push_back({{"lights", c.lights},
                                 {"lighting", c.lighting},
                                 {"estimator", c.estimator},
                                 {"spp", c.spp},
                                 {"all", metrics(c.all)},
                                 {"smooth", metrics(c.smooth)},
                                 {"silhouettes", metrics(c.silhouettes)}});
    }
    for (const auto& [what, eps] : experiment.residual)
        json["residual"].push_back({{"between", what}, {"eps_mean", eps}});
    for (const Race& r : experiment.races) {
        json["races"].push_back({{"triangles", r.triangles},
                                 {"closed_form", r.transport},
                                 {"sampled", r.sampled},
                                 {"opengl", r.openGl},
                                 {"closed_form_total", r.transportAll},
                                 {"opengl_total", r.openGlAll}});
    }
    return jsonText(json);
}

}  // namespace duolux
