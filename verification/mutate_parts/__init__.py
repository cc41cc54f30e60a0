"""What mutate.py and sabotage.py share: changes to the code, a copy to make them in, the tests that must notice."""
