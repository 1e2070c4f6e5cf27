# Compiles a GLSL kernel to SPIR-V, validates it, and embeds it as a C++ array.
#
#   duolux_shader(TARGET NAME SOURCE [DEFINES A=1 B])
#
# adds `extern const std::span<const std::uint32_t> NAME` (namespace duolux::spirv) to the library TARGET.
# Through glslang's dependency file, a changed header rebuilds the kernels that include it.
find_program(GLSLANG_VALIDATOR NAMES glslangValidator glslang REQUIRED)
find_program(SPIRV_VAL NAMES spirv-val REQUIRED)
find_program(SPIRV_OPT NAMES spirv-opt REQUIRED)

# The driver inlines and cleans up at every start, for which it takes three times as long as for the result of these
# passes. They are those of `spirv-opt -O` without --ssa-rewrite, after which lavapipe keeps more values in
# memory: kernels would take 1.1 to 1.9 times as long.
set(DUOLUX_SPIRV_PASSES
  --eliminate-dead-branches --merge-return --inline-entry-points-exhaustive --eliminate-dead-functions
  --eliminate-dead-code-aggressive --private-to-local --eliminate-local-single-block --eliminate-local-single-store
  --eliminate-dead-code-aggressive --scalar-replacement=100 --convert-local-access-chains --eliminate-local-single-block
  --eliminate-local-single-store --eliminate-dead-code-aggressive --redundancy-elimination --simplify-instructions
  --vector-dce --eliminate-dead-inserts --eliminate-dead-code-aggressive)

function(duolux_shader target name source)
  cmake_parse_arguments(ARG "" "" "DEFINES" ${ARGN})
  set(input ${CMAKE_CURRENT_SOURCE_DIR}/${source})
  set(dir ${CMAKE_CURRENT_BINARY_DIR}/spirv)
  file(MAKE_DIRECTORY ${dir})
  set(spv ${dir}/${name}.spv)
  set(cpp ${dir}/${name}.spv.cpp)
  list(TRANSFORM ARG_DEFINES PREPEND -D)
  add_custom_command(
    OUTPUT ${spv}
    COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.2 -I${CMAKE_SOURCE_DIR} ${ARG_DEFINES}
            --depfile ${spv}.d -o ${spv} ${input}
    COMMAND ${SPIRV_OPT} ${DUOLUX_SPIRV_PASSES} ${spv} -o ${spv}
    COMMAND ${SPIRV_VAL} --target-env vulkan1.2 --scalar-block-layout ${spv}
    DEPENDS ${input}
    DEPFILE ${spv}.d
    COMMENT "GLSL ${source} -> ${name}.spv"
    VERBATIM)
  add_custom_command(
    OUTPUT ${cpp}
    COMMAND ${CMAKE_COMMAND} -DSPV=${spv} -DCPP=${cpp} -DNAME=${name}
            -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/EmbedSpirv.cmake
    DEPENDS ${spv} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/EmbedSpirv.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${cpp})
endfunction()
