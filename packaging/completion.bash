# Completion of lararium-editor and lararium-player: what their own --help lists.
_lararium() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} subcommand='' known help
  known=$("$program" --help 2> /dev/null | sed -n '/^Subcommands:/,$s/^  \([a-z-]\+\) .*/\1/p')
  local given
  for given in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    if grep -qxF -- "$given" <<< "$known"; then
      subcommand=$given
      break
    fi
  done
  if [[ $word == -* ]]; then
    help=$("$program" $subcommand --help 2> /dev/null)
    mapfile -t COMPREPLY < <(compgen -W "$(sed -n 's/^ *\(-[a-z],\)\?\(--[a-z0-9-]\+\).*/\2/p' <<< "$help")" -- "$word")
  elif [[ -z $subcommand && $COMP_CWORD -eq 1 ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$known" -- "$word"; compgen -f -- "$word")
  fi
}
complete -o default -F _lararium lararium-editor lararium-player
