// Reads pieces of a scene's text on several threads, with findings as if one had read them in their order.
#pragma once

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <deque>

#include "raytrace/description/diagnostics.h"
#include "raytrace/description/scene_text.h"
#include "raytrace/description/variables.h"
#include "raytrace/parallel/in_order.h"

namespace raytrace {

/// For each piece, in their order: take(the piece's index, result), with what read(index, tools, result, diagnostics)
/// has left in a result, a container that was empty. read is called by several threads at once, each time with Tools,
/// made of a text and variables, that nobody else uses; take by one at a time.
///
/// Pieces are read without a message at first. Where there is something to say, the piece is read once more when all
/// before it have been taken: so no more messages are composed than are kept, and they do not depend on the threads.
template <class Result, class Tools, class Read, class Take>
void read_pieces(const SceneText& text, const Variables& variables, const SceneText::PieceRange& pieces,
                 tbb::task_arena& arena, Diagnostics& diagnostics, const Read& read, const Take& take) {
  struct Workplace {
    Workplace(const SceneText& text, const Variables& variables) : tools(text, variables) {}

    Tools tools;
    Result result;
    Diagnostics findings = Diagnostics::counter();
  };
  const auto read_piece = [&](std::size_t i, Workplace& workplace, Diagnostics& findings) {
    workplace.result.clear();
    read(pieces.first + i, workplace.tools, workplace.result, findings);
  };
  const auto read_quietly = [&](std::size_t i, Workplace& workplace) {
    workplace.findings = Diagnostics::counter();
    read_piece(i, workplace, workplace.findings);
  };
  const auto tell_and_take = [&](std::size_t i, Workplace& workplace) {
    const Diagnostics& findings = workplace.findings;
    const bool tell_errors = findings.error_count() > 0 && diagnostics.keeps_another(Severity::error);
    const bool tell_warnings = findings.warning_count() > 0 && diagnostics.keeps_another(Severity::warning);
    if (tell_errors || tell_warnings)
      read_piece(i, workplace, diagnostics);
    else
      diagnostics.count(findings);
    take(pieces.first + i, workplace.result);
  };

  // Enough that no thread waits for one that has a longer piece.
  const std::size_t enough = 4 * static_cast<std::size_t>(arena.max_concurrency());
  std::deque<Workplace> workplaces;  // no vector, since they cannot be moved
  for (std::size_t i = 0; i < std::min(pieces.count, enough); ++i) workplaces.emplace_back(text, variables);
  in_order(pieces.count, workplaces, arena, read_quietly, tell_and_take);
}

}  // namespace raytrace
