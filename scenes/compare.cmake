# cmake -DGENERATOR=… -DCOMMITTED=… -DFRESH=… -P compare.cmake: generates the scenes into FRESH and
# compares them with the committed ones, both ways, byte by byte.
file(REMOVE_RECURSE ${FRESH})
file(MAKE_DIRECTORY ${FRESH})
execute_process(COMMAND ${GENERATOR} ${FRESH} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the generator failed: ${result}")
endif()

set(kinds "*.gltf" "*.bin" "*.hdr" "*.png")
list(TRANSFORM kinds PREPEND ${FRESH}/ OUTPUT_VARIABLE fresh_kinds)
list(TRANSFORM kinds PREPEND ${COMMITTED}/ OUTPUT_VARIABLE committed_kinds)
file(GLOB fresh RELATIVE ${FRESH} ${fresh_kinds})
file(GLOB committed RELATIVE ${COMMITTED} ${committed_kinds})
if(NOT fresh STREQUAL committed)
  message(FATAL_ERROR "made: ${fresh}\ncommitted: ${committed}")
endif()
foreach(name IN LISTS fresh)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${FRESH}/${name} ${COMMITTED}/${name}
    RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(SEND_ERROR "${name} differs (cmake --build … --target update_scenes writes it anew)")
  endif()
endforeach()
