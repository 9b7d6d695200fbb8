# Builds the scenes of configs/ and the script that plots into a library, so that the program can verify itself wherever
# it is.
function(add_scene_texts target)
  file(GLOB scenes CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/configs ${PROJECT_SOURCE_DIR}/configs/*.toml
       ${PROJECT_SOURCE_DIR}/configs/verification/*.toml)
  set(plot_script ${PROJECT_SOURCE_DIR}/tools/plot_verification.py)
  set(texts "")
  foreach(scene IN LISTS scenes)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/configs/${scene})
    file(READ ${PROJECT_SOURCE_DIR}/configs/${scene} text)
    string(APPEND texts "    {\"${scene}\", R\"raw(${text})raw\"},\n")
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${plot_script})
  file(READ ${plot_script} script)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/scene_texts.cpp @ONLY CONTENT
"#include \"verification/scene_texts.hpp\"

namespace spindrift {

std::span<const SceneText> scene_texts() {
  static constexpr SceneText texts[] = {
@texts@  };
  return texts;
}

std::string_view plot_script() {
  return R\"raw(@script@)raw\";
}

}  // namespace spindrift
")
  target_sources(${target} PRIVATE ${PROJECT_BINARY_DIR}/generated/scene_texts.cpp)
endfunction()
