# cmake -DSPV=in.spv -DCPP=out.cpp -DNAME=identifier -P EmbedSpirv.cmake
file(READ ${SPV} hex HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1,\n" words "${hex}")
file(WRITE ${CPP} "// Generated from SPIR-V; do not edit.
#include <cstdint>
#include <span>

namespace duolux::spirv {
namespace {
constexpr std::uint32_t ${NAME}Words[] = {
${words}};
}  // namespace
extern const std::span<const std::uint32_t> ${NAME};
const std::span<const std::uint32_t> ${NAME}{${NAME}Words};
}  // namespace duolux::spirv
")
