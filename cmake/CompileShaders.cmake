# Compiles a GLSL kernel to SPIR-V, validates it, and embeds it as a C++ array.
#
#   duolux_shader(TARGET NAME SOURCE [DEFINES A=1 B])
#
# adds `extern const std::span<const std::uint32_t> NAME` (namespace duolux::spirv) to the library TARGET.
# Through glslang's dependency file, a changed header rebuilds the kernels that include it.
find_program(GLSLANG_VALIDATOR NAMES glslangValidator glslang REQUIRED)
find_program(SPIRV_VAL NAMES spirv-val REQUIRED)
find_program(SPIRV_OPT NAMES spirv-opt REQUIRED)

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
    # Drops what constants of the preprocessor leave without use; the driver would read and compile it first.
    COMMAND ${SPIRV_OPT} --eliminate-dead-branches --eliminate-dead-functions --eliminate-dead-code-aggressive ${spv} -o ${spv}
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
