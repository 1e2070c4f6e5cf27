#include "host/render/teams.h"

#include <algorithm>
#include <cassert>

#include "shaders/shared/path_layout.h"

namespace duolux {

namespace {

using Stage = vk::PipelineStageFlagBits;
using Access = vk::AccessFlagBits;

void barrier(const vk::raii::CommandBuffer& commands, vk::PipelineStageFlags before, vk::AccessFlags written,
             vk::PipelineStageFlags after, vk::AccessFlags used) {
    commands.pipelineBarrier(before, after, {}, vk::MemoryBarrier(written, used), {}, {});
}

constexpr vk::AccessFlags kShader = Access::eShaderRead | Access::eShaderWrite;

}  // namespace

Teams::Teams(const Device& device, const Tuning& tuning, std::uint32_t maxItems)
    : lanes_(tuning.lanes),
      workgroupSize_(tuning.workgroupSize),
      fewestTeams_(tuning.fewestTeams),
      maxItems_(maxItems),
      progress_(Buffer::device(
          device, BufferUse::kStorage, 2 * sizeof(shared::TeamProgress) * std::uint64_t{maxItems},
          vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst, "progress")),
      read_(Buffer::readback(device, progress_.size(), "progress", vk::BufferUsageFlagBits::eTransferDst)) {}

std::uint32_t Teams::share(std::uint32_t items, std::uint32_t laneItems) const {
    const std::uint32_t fair = std::max(items / (fewestTeams_ * lanes_), 1u);
    return std::min(std::max(laneItems, 1u), fair) * lanes_;
}

std::uint32_t Teams::begin(const vk::raii::CommandBuffer& commands, unsigned place, std::uint32_t items,
                           std::uint32_t teamItems) {
    assert(items <= maxItems_);
    const std::uint32_t teams = (items + teamItems - 1) / teamItems;
    dispatches_[place] = {items, teamItems, teams};
    // The dispatch in the other place uses different parts of the same buffers.
    barrier(commands, Stage::eComputeShader | Stage::eTransfer,
            kShader | Access::eTransferRead | Access::eTransferWrite,
            Stage::eComputeShader | Stage::eTransfer, kShader | Access::eTransferWrite);
    commands.fillBuffer(progress_.handle(), firstTeam(place) * sizeof(shared::TeamProgress),
                        teams * sizeof(shared::TeamProgress), 0);
    barrier(commands, Stage::eTransfer, Access::eTransferWrite, Stage::eComputeShader, kShader);
    return teams;
}

void Teams::end(const vk::raii::CommandBuffer& commands, unsigned place) const {
    barrier(commands, Stage::eComputeShader, Access::eShaderWrite, Stage::eTransfer, Access::eTransferRead);
    const std::uint64_t offset = firstTeam(place) * sizeof(shared::TeamProgress);
    commands.copyBuffer(
        progress_.handle(), read_.handle(),
        vk::BufferCopy(offset, offset, dispatches_[place].teams * sizeof(shared::TeamProgress)));
}

bool Teams::complete(unsigned place) const {
    read_.invalidate();
    const auto* team =
        reinterpret_cast<const shared::TeamProgress*>(read_.mapped()) + std::size_t{firstTeam(place)};
    const auto& [items, teamItems, teams] = dispatches_[place];
    for (std::uint32_t i = 0; i < teams; ++i) {
        if (team[i].finished != std::min(teamItems, items - i * teamItems)) return false;
    }
    return true;
}

}  // namespace duolux
