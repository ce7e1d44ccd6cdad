# Warnings are errors. Floating-point contraction stays off so that a result does not depend on the machine's
# fused multiply-add: same input, same bytes.
add_compile_options(-Wall -Wextra -Wconversion -Wshadow -Werror -ffp-contract=off)

# GCC 12 reports overlapping copies in "literal" + std::string at -O3, where there are none (GCC bug 105651).
add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)

if(LAMINA_SANITIZE)
  # GCC 12 sees uninitialised members in std::regex once it is instrumented.
  add_compile_options(-fsanitize=${LAMINA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    -Wno-maybe-uninitialized)
  add_link_options(-fsanitize=${LAMINA_SANITIZE})
endif()

if(LAMINA_TIDY)
  find_program(LAMINA_CLANG_TIDY clang-tidy REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY ${LAMINA_CLANG_TIDY} --quiet --extra-arg=-Wno-unknown-warning-option)
endif()

# lamina_library(NAME folder SOURCES... LINK...): one static library per top-level folder, included from the root.
function(lamina_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(lamina_${name} STATIC ${ARG_SOURCES})
  add_library(lamina::${name} ALIAS lamina_${name})
  target_include_directories(lamina_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(lamina_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
endfunction()
