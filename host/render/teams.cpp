#include "host/render/teams.h"

#include <algorithm>
#include <cassert>

#include "shaders/shared/path_tracer_layout.h"

namespace duolux {

Teams::Teams(const Device& device, const Tuning& tuning, std::uint32_t maxItems)
    : lanes_(tuning.lanes),
      workgroupSize_(tuning.workgroupSize),
      fewestTeams_(tuning.fewestTeams),
      maxItems_(maxItems),
      progress_(Buffer::device(device, BufferUse::kStorage,
                               2 * sizeof(shared::TeamProgress) * std::uint64_t{maxItems}, "progress")),
      read_(Buffer::readback(device, progress_.size(), "progress")) {}

std::uint32_t Teams::share(std::uint32_t items, std::uint32_t laneItems) const {
    const std::uint32_t fair = std::max(items / (fewestTeams_ * lanes_), 1u);
    return std::min(std::max(laneItems, 1u), fair) * lanes_;
}

std::uint32_t Teams::begin(const Commands& commands, unsigned slot, std::uint32_t items,
                           std::uint32_t teamItems) {
    assert(items <= maxItems_);
    const std::uint32_t teams = (items + teamItems - 1) / teamItems;
    dispatches_[slot] = {items, teamItems, teams};
    // The dispatch in the other slot uses different parts of the same buffers.
    commands.barrier(Work::kAll, Work::kAll);
    commands.fill(progress_, firstTeam(slot) * sizeof(shared::TeamProgress),
                  teams * sizeof(shared::TeamProgress), 0);
    commands.barrier(Work::kTransfers, Work::kKernels);
    return teams;
}

void Teams::end(const Commands& commands, unsigned slot) const {
    commands.barrier(Work::kKernels, Work::kTransfers);
    const std::uint64_t offset = firstTeam(slot) * sizeof(shared::TeamProgress);
    commands.copy(progress_, offset, read_, offset, dispatches_[slot].teams * sizeof(shared::TeamProgress));
}

bool Teams::complete(unsigned slot) const {
    read_.invalidate();
    const auto* team =
        reinterpret_cast<const shared::TeamProgress*>(read_.mapped()) + std::size_t{firstTeam(slot)};
    const auto& [items, teamItems, teams] = dispatches_[slot];
    for (std::uint32_t i = 0; i < teams; ++i) {
        if (team[i].finished != std::min(teamItems, items - i * teamItems)) return false;
    }
    return true;
}

}  // namespace duolux
