# teren_add_plugin(<id> <source>...): the target plugin-<id>, a module teren-<id>.so in the folder TEREN_PLUGIN_DIRECTORY
# (the build's "plugins" where that is not set). A folder of modules is put before the engine's own with the
# environment variable TEREN_PLUGIN_PATH.
function(teren_add_plugin id)
  if(NOT TEREN_PLUGIN_DIRECTORY)
    set(TEREN_PLUGIN_DIRECTORY ${CMAKE_BINARY_DIR}/plugins)
  endif()
  add_library(plugin-${id} MODULE ${ARGN})
  target_link_libraries(plugin-${id} PRIVATE Teren::api)
  set_target_properties(plugin-${id} PROPERTIES PREFIX "" OUTPUT_NAME teren-${id} CXX_VISIBILITY_PRESET hidden
                                                LIBRARY_OUTPUT_DIRECTORY ${TEREN_PLUGIN_DIRECTORY})
endfunction()
