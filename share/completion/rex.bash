# Completion of rex for bash: rex itself knows its commands, options, exercises and postures. Bash takes a colon
# for the end of a word.
_rex() {
  local IFS=$'\n' word begun=
  local -a words=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD}"; do
    if ((${#words[@]})) && [[ $word == : || ${words[-1]} == *: ]]; then
      words[-1]+=$word
    else
      words+=("$word")
    fi
  done
  [[ ${words[-1]} == *:* ]] && begun=${words[-1]%"${words[-1]##*:}"}
  COMPREPLY=($(rex --complete "${words[@]}" 2>/dev/null))
  COMPREPLY=("${COMPREPLY[@]#"$begun"}")
}
complete -o default -o bashdefault -F _rex rex
