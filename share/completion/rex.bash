# Completion of rex for bash: rex itself knows its commands, options and exercises.
_rex() {
  local IFS=$'\n'
  COMPREPLY=($(rex --complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
}
complete -o default -o bashdefault -F _rex rex
