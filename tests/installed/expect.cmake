# Runs a command, which has to succeed and to print what the pattern asks for.
function(expect pattern)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE status)
  list(JOIN ARGN " " command)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${command}\n${output}")
  endif()
  if(NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "${command}\ndoes not print ${pattern}:\n${output}")
  endif()
endfunction()

# Manual pages, completion, scenes and pages of an installed vehd.
function(look_at_texts prefix)
  file(GLOB manual "${prefix}/share/man/man1/vehd.1.gz")
  if(manual)
    expect("--resume" sh -c "zcat ${prefix}/share/man/man1/vehd-run.1.gz | sed 's/\\\\\\\\-/-/g'")
    expect("simulate lipid vesicles" zcat "${manual}")
  endif()
  foreach(file IN ITEMS share/vehd/scenes/figure2.toml share/doc/vehd/README.md share/doc/vehd/conventions.md
                        share/doc/vehd/CITATION.cff)
    if(NOT EXISTS "${prefix}/${file}")
      message(FATAL_ERROR "${file} is not installed")
    endif()
  endforeach()
  # Bash offers the one command that begins so, and the option of that command.
  expect("^plan plot \n" bash -c "source '${prefix}/share/bash-completion/completions/vehd'
COMP_WORDS=(vehd pl) COMP_CWORD=1; _vehd; printf '%s ' \"\${COMPREPLY[@]}\"; echo")
  expect("^--resume \n" bash -c "source '${prefix}/share/bash-completion/completions/vehd'
COMP_WORDS=(vehd run --res) COMP_CWORD=2; _vehd; printf '%s ' \"\${COMPREPLY[@]}\"; echo")
  find_program(zsh zsh NO_CACHE)
  if(zsh)
    expect("plot:.*run:" "${zsh}" -fc "_describe() { print -l \"\${(@P)2}\" }; _files() { : }
words=(vehd ''); CURRENT=2; PREFIX=''; source '${prefix}/share/zsh/vendor-completions/_vehd'")
    expect("--resume:" "${zsh}" -fc "_describe() { [ \"$1\" = -o ] && shift; print -l \"\${(@P)2}\" }; _files() { : }
words=(vehd run --); CURRENT=3; PREFIX='--'; source '${prefix}/share/zsh/vendor-completions/_vehd'")
  endif()
endfunction()
