"""What cut_and_restart.py and kill_and_restart.py share."""
